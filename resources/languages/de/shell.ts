<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>engine</name>
    <message>
        <source>position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>voltage</source>
        <translation>Spannung</translation>
    </message>
    <message>
        <source>speed</source>
        <translation>Geschwindigkeit</translation>
    </message>
    <message>
        <source>acceleration</source>
        <translation>Beschleunigung</translation>
    </message>
    <message>
        <source>predicted motion</source>
        <translation>vorhergesagte Bewegung</translation>
    </message>
    <message>
        <source>closing a loop</source>
        <translation>Regelkreis schließen</translation>
    </message>
    <message>
        <source>opening a loop</source>
        <translation>Regelkreis öffnen</translation>
    </message>
    <message>
        <source>applying an inverse</source>
        <translation>Inverse einschalten</translation>
    </message>
    <message>
        <source>removing an inverse</source>
        <translation>Inverse abschalten</translation>
    </message>
    <message>
        <source>teaching the floor</source>
        <translation>Boden setzen</translation>
    </message>
    <message>
        <source>removing the floor</source>
        <translation>Boden entfernen</translation>
    </message>
    <message>
        <source>reserving the axes</source>
        <translation>Achsen reservieren</translation>
    </message>
    <message>
        <source>changing the approach of an axis</source>
        <translation>Ändern, wie eine Achse ihre Ziele anfährt</translation>
    </message>
    <message>
        <source>narrowing a range</source>
        <translation>Einengen eines Bereichs</translation>
    </message>
    <message>
        <source>restoring a range</source>
        <translation>Wiederherstellen eines Bereichs</translation>
    </message>
    <message>
        <source>a profile</source>
        <translation>Profil</translation>
    </message>
    <message>
        <source>setting a voltage</source>
        <translation>Spannung ausgeben</translation>
    </message>
    <message>
        <source>accept its parameters</source>
        <translation>seine Parameter annehmen</translation>
    </message>
    <message>
        <source>capture</source>
        <translation>schnell aufzeichnen</translation>
    </message>
    <message>
        <source>change a compensation</source>
        <translation>eine Kompensation ändern</translation>
    </message>
    <message>
        <source>change a loop</source>
        <translation>einen Regelkreis ändern</translation>
    </message>
    <message>
        <source>change its effects</source>
        <translation>seine Effekte ändern</translation>
    </message>
    <message>
        <source>clear a fault</source>
        <translation>einen Fehler quittieren</translation>
    </message>
    <message>
        <source>home</source>
        <translation>Referenzfahrt machen</translation>
    </message>
    <message>
        <source>play</source>
        <translation>abspielen</translation>
    </message>
    <message>
        <source>set a voltage</source>
        <translation>eine Spannung ausgeben</translation>
    </message>
    <message>
        <source>read</source>
        <translation>lesen</translation>
    </message>
    <message>
        <source>run a profile</source>
        <translation>ein Profil ausführen</translation>
    </message>
    <message>
        <source>show text</source>
        <translation>einen Text anzeigen</translation>
    </message>
    <message>
        <source>switch the tool off</source>
        <translation>das Werkzeug abschalten</translation>
    </message>
    <message>
        <source>switch the tool on</source>
        <translation>das Werkzeug einschalten</translation>
    </message>
    <message>
        <source>accept a profile</source>
        <translation>ein Profil annehmen</translation>
    </message>
    <message>
        <source>write its parameters</source>
        <translation>seine Parameter schreiben</translation>
    </message>
    <message>
        <source>resume</source>
        <translation>fortsetzen</translation>
    </message>
    <message>
        <source>step through</source>
        <translation>schrittweise abspielen</translation>
    </message>
    <message>
        <source>start over</source>
        <translation>von vorn beginnen</translation>
    </message>
    <message>
        <source>operator</source>
        <translation>Bediener</translation>
    </message>
    <message>
        <source>playback</source>
        <translation>Wiedergabe</translation>
    </message>
    <message>
        <source>homing</source>
        <translation>Referenzfahrt</translation>
    </message>
    <message>
        <source>joystick</source>
        <translation>Joystick</translation>
    </message>
    <message>
        <source>penetration</source>
        <translation>Penetration</translation>
    </message>
    <message>
        <source>closed</source>
        <translation>geschlossen</translation>
    </message>
    <message>
        <source>opening</source>
        <translation>wird geöffnet</translation>
    </message>
    <message>
        <source>live</source>
        <translation>live</translation>
    </message>
    <message>
        <source>stalled</source>
        <translation>stockt</translation>
    </message>
    <message>
        <source>frozen</source>
        <translation>eingefroren</translation>
    </message>
    <message>
        <source>black</source>
        <translation>schwarz</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>verloren</translation>
    </message>
    <message>
        <source>calibration</source>
        <translation>Kalibrierung</translation>
    </message>
    <message>
        <source>click</source>
        <translation>Klick</translation>
    </message>
    <message>
        <source>visit of a target</source>
        <translation>Zielfahrt</translation>
    </message>
    <message>
        <source>autofocus</source>
        <translation>Autofokus</translation>
    </message>
    <message>
        <source>z-stack</source>
        <translation>Z-Stapel</translation>
    </message>
    <message>
        <source>off</source>
        <translation>aus</translation>
    </message>
    <message>
        <source>searched</source>
        <translation>gesucht</translation>
    </message>
    <message>
        <source>tracked</source>
        <translation>verfolgt</translation>
    </message>
    <message>
        <source>under way</source>
        <translation>unterwegs</translation>
    </message>
    <message>
        <source>arrived</source>
        <translation>erreicht</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>gescheitert</translation>
    </message>
    <message>
        <source>micro</source>
        <translation>Mikro</translation>
    </message>
    <message>
        <source>nano</source>
        <translation>Nano</translation>
    </message>
    <message>
        <source>mono8</source>
        <translation>mono8</translation>
    </message>
    <message>
        <source>mono16</source>
        <translation>mono16</translation>
    </message>
    <message>
        <source>colour</source>
        <translation>Farbe</translation>
    </message>
    <message>
        <source>free-running</source>
        <translation>frei laufend</translation>
    </message>
    <message>
        <source>software</source>
        <translation>Software</translation>
    </message>
    <message>
        <source>grey</source>
        <translation>grau</translation>
    </message>
    <message>
        <source>grey, inverted</source>
        <translation>grau, invertiert</translation>
    </message>
    <message>
        <source>viridis</source>
        <translation>viridis</translation>
    </message>
    <message>
        <source>grey, saturated red</source>
        <translation>grau, gesättigt rot</translation>
    </message>
    <message>
        <source>crosshair</source>
        <translation>Fadenkreuz</translation>
    </message>
    <message>
        <source>tip</source>
        <translation>Spitze</translation>
    </message>
    <message>
        <source>targets</source>
        <translation>Ziele</translation>
    </message>
    <message>
        <source>path</source>
        <translation>Bahn</translation>
    </message>
    <message>
        <source>range of the nano stage</source>
        <translation>Bereich des Nanotischs</translation>
    </message>
    <message>
        <source>cell</source>
        <translation>Zelle</translation>
    </message>
    <message>
        <source>measure</source>
        <translation>Messung</translation>
    </message>
    <message>
        <source>pan</source>
        <translation>Schieben</translation>
    </message>
    <message>
        <source>move</source>
        <translation>Fahren</translation>
    </message>
    <message>
        <source>mark</source>
        <translation>Ziel</translation>
    </message>
    <message>
        <source>disarmed</source>
        <translation>entschärft</translation>
    </message>
    <message>
        <source>armed</source>
        <translation>scharf</translation>
    </message>
    <message>
        <source>approach</source>
        <translation>Anfahrt</translation>
    </message>
    <message>
        <source>contact</source>
        <translation>Kontakt</translation>
    </message>
    <message>
        <source>thrust</source>
        <translation>Einstich</translation>
    </message>
    <message>
        <source>hold</source>
        <translation>Halten</translation>
    </message>
    <message>
        <source>inject</source>
        <translation>Injektion</translation>
    </message>
    <message>
        <source>hold after</source>
        <translation>Nachhalten</translation>
    </message>
    <message>
        <source>retract</source>
        <translation>Rückzug</translation>
    </message>
    <message>
        <source>aborted</source>
        <translation>abgebrochen</translation>
    </message>
    <message>
        <source>held</source>
        <translation>gehalten</translation>
    </message>
    <message>
        <source>no contact</source>
        <translation>kein Kontakt</translation>
    </message>
    <message>
        <source>axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>direction</source>
        <translation>Richtung</translation>
    </message>
    <message>
        <source>shape</source>
        <translation>Form</translation>
    </message>
    <message>
        <source>shaping</source>
        <translation>Impulsformung</translation>
    </message>
    <message>
        <source>table</source>
        <translation>Tabelle</translation>
    </message>
    <message>
        <source>down</source>
        <translation>abwärts</translation>
    </message>
    <message>
        <source>up</source>
        <translation>aufwärts</translation>
    </message>
    <message>
        <source>passed</source>
        <translation>durchlaufen</translation>
    </message>
    <message>
        <source>present</source>
        <translation>aktiv</translation>
    </message>
    <message>
        <source>fine</source>
        <translation>fein</translation>
    </message>
    <message>
        <source>coarse</source>
        <translation>grob</translation>
    </message>
    <message>
        <source>playing</source>
        <translation>spielt ab</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>move the axis now</source>
        <translation>jetzt die Achse bewegen</translation>
    </message>
    <message>
        <source>Permission denied</source>
        <translation>keine Berechtigung</translation>
    </message>
    <message>
        <source>No such file or directory</source>
        <translation>diese Datei oder diesen Ordner gibt es nicht</translation>
    </message>
    <message>
        <source>File exists</source>
        <translation>gibt es schon</translation>
    </message>
    <message>
        <source>Is a directory</source>
        <translation>das ist ein Ordner</translation>
    </message>
    <message>
        <source>Not a directory</source>
        <translation>das ist kein Ordner</translation>
    </message>
    <message>
        <source>No space left on device</source>
        <translation>kein Platz mehr auf dem Datenträger</translation>
    </message>
    <message>
        <source>Read-only file system</source>
        <translation>der Datenträger ist nur lesbar</translation>
    </message>
    <message>
        <source>Input/output error</source>
        <translation>Ein-/Ausgabefehler</translation>
    </message>
    <message>
        <source>Re-centring</source>
        <translation>Zentrieren</translation>
    </message>
    <message>
        <source>Preparing</source>
        <translation>Vorbereiten</translation>
    </message>
    <message>
        <source>the system reports: “{text}”</source>
        <extracomment>Names of the languages, each in its own language.</extracomment>
        <translation>das System meldet: „{text}“</translation>
    </message>
    <message>
        <source>or</source>
        <translation>oder</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>{file}: {reason}</source>
        <translation>{file}: {reason}</translation>
    </message>
    <message>
        <source>{output}: the folder cannot be created: {strerror}</source>
        <translation>{output}: der Ordner lässt sich nicht anlegen: {strerror}</translation>
    </message>
    <message>
        <source>{picture}: the picture cannot be written</source>
        <translation>{picture}: das Bild lässt sich nicht schreiben</translation>
    </message>
</context>
<context>
    <name>shell</name>
    <message>
        <source>The layout is not saved: {objection}.</source>
        <translation>Die Anordnung ist nicht gespeichert: {objection}.</translation>
    </message>
    <message>
        <source>The layout is saved as {name!r}.</source>
        <translation>Die Anordnung ist als {name!r} gespeichert.</translation>
    </message>
    <message>
        <source>Inspecting {name} …</source>
        <translation>{name} wird untersucht …</translation>
    </message>
    <message>
        <source>Columns of {name}</source>
        <translation>Spalten von {name}</translation>
    </message>
    <message>
        <source>column {number}</source>
        <translation>Spalte {number}</translation>
    </message>
    <message>
        <source>&amp;Dark theme</source>
        <translation>&amp;Dunkles Farbschema</translation>
    </message>
    <message>
        <source>&amp;Light theme</source>
        <translation>H&amp;elles Farbschema</translation>
    </message>
    <message>
        <source>&amp;High contrast</source>
        <translation>&amp;Hoher Kontrast</translation>
    </message>
    <message>
        <source>there is no record; play a trajectory or open one</source>
        <translation>es gibt keine Aufzeichnung; eine Trajektorie abspielen oder eine öffnen</translation>
    </message>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Datei</translation>
    </message>
    <message>
        <source>Load &amp;trajectory …</source>
        <translation>&amp;Trajektorie laden …</translation>
    </message>
    <message>
        <source>Load and dry-run</source>
        <translation>Laden und am Modell prüfen</translation>
    </message>
    <message>
        <source>Trajectory from &amp;record …</source>
        <translation>Trajektorie aus Auf&amp;zeichnung …</translation>
    </message>
    <message>
        <source>&amp;Open record …</source>
        <translation>Aufzeichnung &amp;öffnen …</translation>
    </message>
    <message>
        <source>Compare with the model</source>
        <translation>Mit dem Modell vergleichen</translation>
    </message>
    <message>
        <source>&amp;Save record …</source>
        <translation>Aufzeichnung &amp;speichern …</translation>
    </message>
    <message>
        <source>Save the last record</source>
        <translation>Die letzte Aufzeichnung speichern</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>&amp;Beenden</translation>
    </message>
    <message>
        <source>there is no trajectory; load one first</source>
        <translation>es gibt keine Trajektorie; erst eine laden</translation>
    </message>
    <message>
        <source>no device is connected</source>
        <translation>kein Gerät ist verbunden</translation>
    </message>
    <message>
        <source>there is no fault</source>
        <translation>es liegt kein Fehler vor</translation>
    </message>
    <message>
        <source>&amp;Motion</source>
        <translation>&amp;Bewegung</translation>
    </message>
    <message>
        <source>&amp;Play or pause</source>
        <translation>&amp;Abspielen oder Pause</translation>
    </message>
    <message>
        <source>The trajectory</source>
        <translation>Die Trajektorie</translation>
    </message>
    <message>
        <source>&amp;Stop</source>
        <translation>&amp;Halt</translation>
    </message>
    <message>
        <source>the machine is not locked</source>
        <translation>die Maschine ist nicht gesperrt</translation>
    </message>
    <message>
        <source>Stop and loc&amp;k</source>
        <translation>Halt und s&amp;perren</translation>
    </message>
    <message>
        <source>Stop the machine and quit</source>
        <translation>Maschine anhalten und Programm beenden</translation>
    </message>
    <message>
        <source>Re&amp;lease the lock</source>
        <translation>Sperre &amp;freigeben</translation>
    </message>
    <message>
        <source>Let axes move</source>
        <translation>Achsen dürfen sich bewegen</translation>
    </message>
    <message>
        <source>Retract, travel, approach</source>
        <translation>Zurückziehen, verfahren, annähern</translation>
    </message>
    <message>
        <source>&amp;Home all axes</source>
        <translation>Referenzfahrt aller A&amp;chsen</translation>
    </message>
    <message>
        <source>Find the limit switches</source>
        <translation>Endschalter suchen</translation>
    </message>
    <message>
        <source>&amp;Clear fault</source>
        <translation>Fehler &amp;quittieren</translation>
    </message>
    <message>
        <source>C&amp;onnect …</source>
        <translation>&amp;Verbinden …</translation>
    </message>
    <message>
        <source>Choose a machine or the simulator</source>
        <translation>Eine Maschine oder den Simulator wählen</translation>
    </message>
    <message>
        <source>&amp;Reconnect</source>
        <translation>&amp;Wieder verbinden</translation>
    </message>
    <message>
        <source>Connect after a failure</source>
        <translation>Nach einem Ausfall verbinden</translation>
    </message>
    <message>
        <source>&amp;Disconnect</source>
        <translation>&amp;Trennen</translation>
    </message>
    <message>
        <source>Stop and disconnect</source>
        <translation>Anhalten und trennen</translation>
    </message>
    <message>
        <source>Up to twice the normal size</source>
        <translation>Bis zum Doppelten der normalen Größe</translation>
    </message>
    <message>
        <source>Depends on the height of the screen</source>
        <translation>Richtet sich nach der Höhe des Bildschirms</translation>
    </message>
    <message>
        <source>Type part of its name</source>
        <translation>Einen Teil des Namens eingeben</translation>
    </message>
    <message>
        <source>The panel that has the focus</source>
        <translation>Das Panel mit dem Fokus</translation>
    </message>
    <message>
        <source>All messages of the program</source>
        <translation>Alle Meldungen des Programms</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ansicht</translation>
    </message>
    <message>
        <source>Save la&amp;yout …</source>
        <translation>Anordnung s&amp;peichern …</translation>
    </message>
    <message>
        <source>&amp;Restore the layout</source>
        <translation>Anordnung &amp;zurücksetzen</translation>
    </message>
    <message>
        <source>Larger text</source>
        <translation>Größere Schrift</translation>
    </message>
    <message>
        <source>Smaller text</source>
        <translation>Kleinere Schrift</translation>
    </message>
    <message>
        <source>Text size: automatic</source>
        <translation>Schrift passend zum Bildschirm</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>&amp;Hilfe</translation>
    </message>
    <message>
        <source>&amp;Find a command …</source>
        <translation>Befehl &amp;suchen …</translation>
    </message>
    <message>
        <source>Help on this &amp;panel</source>
        <translation>Hilfe zu diesem &amp;Panel</translation>
    </message>
    <message>
        <source>&amp;All pages</source>
        <translation>&amp;Alle Seiten</translation>
    </message>
    <message>
        <source>They need no network</source>
        <translation>Sie brauchen kein Netz</translation>
    </message>
    <message>
        <source>&amp;Keys</source>
        <translation>&amp;Tasten</translation>
    </message>
    <message>
        <source>All shortcuts</source>
        <translation>Alle Tastenkürzel</translation>
    </message>
    <message>
        <source>&amp;Log</source>
        <translation>Protoko&amp;ll</translation>
    </message>
    <message>
        <source>&amp;Support bundle …</source>
        <translation>Support-Pa&amp;ket …</translation>
    </message>
    <message>
        <source>A&amp;bout RoTeMiNa</source>
        <translation>&amp;Über RoTeMiNa</translation>
    </message>
    <message>
        <source>Version, licence and folders</source>
        <translation>Version, Lizenz und Ordner</translation>
    </message>
    <message>
        <source>{what}: not run, because it may move or switch something and {panel} was hidden. {panel} is open now. Check it, then run the command again.</source>
        <translation>{what}: nicht ausgeführt, weil es etwas bewegen oder schalten kann und {panel} verdeckt war. {panel} ist jetzt offen. Prüfen, dann den Befehl erneut ausführen.</translation>
    </message>
    <message>
        <source>its panel is missing; use the menu</source>
        <translation>das zugehörige Panel fehlt; das Menü benutzen</translation>
    </message>
    <message>
        <source>Panel</source>
        <translation>Panel</translation>
    </message>
    <message>
        <source>Help on {title} (F1)</source>
        <translation>Hilfe zu {title} (F1)</translation>
    </message>
    <message>
        <source>Help on {title}</source>
        <translation>Hilfe zu {title}</translation>
    </message>
    <message>
        <source>Page of the documentation</source>
        <translation>Seite der Dokumentation</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Contents</source>
        <translation>Inhalt</translation>
    </message>
    <message>
        <source>All pages (Alt+Home)</source>
        <translation>Alle Seiten (Alt+Pos1)</translation>
    </message>
    <message>
        <source>Help: {text}</source>
        <translation>Hilfe: {text}</translation>
    </message>
    <message>
        <source>Keys</source>
        <translation>Tasten</translation>
    </message>
    <message>
        <source>Layout: {name}</source>
        <translation>Anordnung: {name}</translation>
    </message>
    <message>
        <source>My layouts</source>
        <translation>Eigene Anordnungen</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Löschen</translation>
    </message>
    <message>
        <source>Save layout</source>
        <translation>Anordnung speichern</translation>
    </message>
    <message>
        <source>Name of the layout (up to {most} letters):</source>
        <translation>Name der Anordnung (bis zu {most} Zeichen):</translation>
    </message>
    <message>
        <source>&amp;Operate</source>
        <translation>&amp;Bedienen</translation>
    </message>
    <message>
        <source>T&amp;une</source>
        <translation>Ab&amp;stimmen</translation>
    </message>
    <message>
        <source>Adjust the machine and its model: identification, calibration, effects</source>
        <translation>Maschine und Modell abstimmen: Identifikation, Kalibrierung, Effekte</translation>
    </message>
    <message>
        <source>Dia&amp;gnose</source>
        <translation>Dia&amp;gnose</translation>
    </message>
    <message>
        <source>&amp;Set up</source>
        <translation>&amp;Einrichten</translation>
    </message>
    <message>
        <source>Prepare the machine: connection, devices, camera, calibration, holding plate</source>
        <translation>Die Maschine vorbereiten: Verbindung, Geräte, Kamera, Kalibrierung, Halteplatte</translation>
    </message>
    <message>
        <source>{name} is a layout of the program; choose another name</source>
        <translation>{name} ist eine Anordnung des Programms; einen anderen Namen wählen</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Level</source>
        <translation>Stufe</translation>
    </message>
    <message>
        <source>Source</source>
        <translation>Quelle</translation>
    </message>
    <message>
        <source>Message</source>
        <translation>Meldung</translation>
    </message>
    <message>
        <source>All messages</source>
        <translation>Alle Meldungen</translation>
    </message>
    <message>
        <source>Warnings and errors</source>
        <translation>Warnungen und Fehler</translation>
    </message>
    <message>
        <source>Errors only</source>
        <translation>Nur Fehler</translation>
    </message>
    <message>
        <source>info</source>
        <translation>Info</translation>
    </message>
    <message>
        <source>good</source>
        <translation>gut</translation>
    </message>
    <message>
        <source>warning</source>
        <translation>Warnung</translation>
    </message>
    <message>
        <source>error</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Log</source>
        <translation>Protokoll</translation>
    </message>
    <message>
        <source>search words</source>
        <translation>Suchwörter</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>Kopieren</translation>
    </message>
    <message>
        <source>All of the selected message</source>
        <translation>Die ganze ausgewählte Meldung</translation>
    </message>
    <message>
        <source>{n} of {all} messages</source>
        <translation>{n} von {all} Meldungen</translation>
    </message>
    <message>
        <source>no message is shown</source>
        <translation>keine Meldung wird gezeigt</translation>
    </message>
    <message>
        <source>Window delay: 99th percentile {usual} ms, worst {worst} ms</source>
        <translation>Verzögerung des Fensters: 99. Perzentil {usual} ms, höchstens {worst} ms</translation>
    </message>
    <message>
        <source>no help page describes it</source>
        <translation>keine Hilfeseite beschreibt sie</translation>
    </message>
    <message>
        <source>Messages, newest first</source>
        <translation>Meldungen, neueste zuerst</translation>
    </message>
    <message>
        <source>Records and trajectories (*.csv *.txt *.dat *.gz);;All files (*)</source>
        <translation>Aufzeichnungen und Trajektorien (*.csv *.txt *.dat *.gz);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Panel {name!r} is left out: {reason}</source>
        <translation>Das Panel {name!r} fehlt: {reason}</translation>
    </message>
    <message>
        <source>trajectory</source>
        <translation>Trajektorie</translation>
    </message>
    <message>
        <source>record</source>
        <translation>Aufzeichnung</translation>
    </message>
    <message>
        <source>Load trajectory</source>
        <translation>Trajektorie laden</translation>
    </message>
    <message>
        <source>Open record</source>
        <translation>Aufzeichnung öffnen</translation>
    </message>
    <message>
        <source>Trajectory from record</source>
        <translation>Trajektorie aus Aufzeichnung</translation>
    </message>
    <message>
        <source>There is no record to save: play or open one.</source>
        <translation>Es gibt keine Aufzeichnung zum Speichern: eine abspielen oder öffnen.</translation>
    </message>
    <message>
        <source>Save record</source>
        <translation>Aufzeichnung speichern</translation>
    </message>
    <message>
        <source>Records (*.csv *.csv.gz)</source>
        <translation>Aufzeichnungen (*.csv *.csv.gz)</translation>
    </message>
    <message>
        <source>Panel {name!r} is missing: it was left out, see the log.</source>
        <translation>Das Fenster {name!r} fehlt: es wurde ausgelassen, siehe Protokoll.</translation>
    </message>
    <message>
        <source>Layout</source>
        <translation>Anordnung</translation>
    </message>
    <message>
        <source>The window closes as soon as everything is written. Close it again to quit at once; the recording can then be recovered at the next start.</source>
        <translation>Das Fenster schließt, sobald alles geschrieben ist. Nochmals schließen beendet sofort; die Aufnahme lässt sich dann beim nächsten Start wiederherstellen.</translation>
    </message>
    <message>
        <source>The machine is moving. Quitting stops it.</source>
        <translation>Die Maschine bewegt sich. Beenden hält sie an.</translation>
    </message>
    <message>
        <source>Stop and quit</source>
        <translation>Anhalten und beenden</translation>
    </message>
    <message>
        <source>Quit and lose it</source>
        <translation>Beenden und verlieren</translation>
    </message>
    <message>
        <source>Quit</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>Stay</source>
        <translation>Bleiben</translation>
    </message>
    <message>
        <source>This is a stop by software, not the machine&apos;s emergency stop switch.</source>
        <translation>Dies ist ein Halt durch Software, nicht der Not-Halt der Maschine.</translation>
    </message>
    <message>
        <source>Stop and lock</source>
        <translation>Halt und sperren</translation>
    </message>
    <message>
        <source>Locked – release</source>
        <translation>Gesperrt – freigeben</translation>
    </message>
    <message>
        <source>Locked: {latched}.</source>
        <translation>Gesperrt: {latched}.</translation>
    </message>
    <message>
        <source>Warnings and errors since the log was opened (Ctrl+L)</source>
        <translation>Warnungen und Fehler, seit das Protokoll geöffnet wurde (Strg+L)</translation>
    </message>
    <message>
        <source>Motion</source>
        <translation>Bewegung</translation>
    </message>
    <message>
        <source>Connect</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>Connect to the device that was used last</source>
        <translation>Mit dem zuletzt benutzten Gerät verbinden</translation>
    </message>
    <message>
        <source>Reconnect</source>
        <translation>Wieder verbinden</translation>
    </message>
    <message>
        <source>Connect again to the device</source>
        <translation>Wieder mit dem Gerät verbinden</translation>
    </message>
    <message>
        <source>Release</source>
        <translation>Freigeben</translation>
    </message>
    <message>
        <source>Clear fault</source>
        <translation>Fehler quittieren</translation>
    </message>
    <message>
        <source>Acknowledge the fault; nothing moves by itself</source>
        <translation>Den Fehler quittieren; von selbst bewegt sich nichts</translation>
    </message>
    <message>
        <source>Compare …</source>
        <translation>Vergleichen …</translation>
    </message>
    <message>
        <source>Open the page on which parameters are written or accepted</source>
        <translation>Die Seite öffnen, auf der Parameter geschrieben oder angenommen werden</translation>
    </message>
    <message>
        <source>Confirm …</source>
        <translation>Bestätigen …</translation>
    </message>
    <message>
        <source>Open the page on which the position is confirmed</source>
        <translation>Die Seite öffnen, auf der die Position bestätigt wird</translation>
    </message>
    <message>
        <source>the button has only just changed</source>
        <translation>die Taste hat sich gerade erst geändert</translation>
    </message>
    <message>
        <source>Home</source>
        <translation>Referenzfahrt</translation>
    </message>
    <message>
        <source>STOP (Esc)</source>
        <translation>HALT (Esc)</translation>
    </message>
    <message>
        <source>Close this notice</source>
        <translation>Diese Meldung schließen</translation>
    </message>
    <message>
        <source>Help on this notice</source>
        <translation>Hilfe zu dieser Meldung</translation>
    </message>
    <message>
        <source>Text of the notice</source>
        <translation>Text der Meldung</translation>
    </message>
    <message>
        <source>+{n} more</source>
        <translation>+{n} weitere</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>Anzeigen</translation>
    </message>
    <message>
        <source>Find a command</source>
        <translation>Befehl suchen</translation>
    </message>
    <message>
        <source>type part of a command</source>
        <translation>Teil eines Befehls eingeben</translation>
    </message>
    <message>
        <source>Part of a command&apos;s name</source>
        <translation>Teil eines Befehlsnamens</translation>
    </message>
    <message>
        <source>Commands</source>
        <translation>Befehle</translation>
    </message>
    <message>
        <source>No command contains these letters.</source>
        <translation>Kein Befehl enthält diese Buchstaben.</translation>
    </message>
    <message>
        <source>Not now: {reason}.</source>
        <translation>Nicht jetzt: {reason}.</translation>
    </message>
    <message>
        <source>Press Enter to open {panel}. This may move or switch something, and runs only while {panel} is visible.</source>
        <translation>Eingabetaste öffnet {panel}. Dies kann etwas bewegen oder schalten und läuft nur, solange {panel} sichtbar ist.</translation>
    </message>
    <message>
        <source>Press Enter to run it.</source>
        <translation>Enter führt es aus.</translation>
    </message>
    <message>
        <source>   – not now: {why_not}</source>
        <translation>   – nicht jetzt: {why_not}</translation>
    </message>
    <message>
        <source>Playing {share:.0f} %</source>
        <translation>Spielt ab, {share:.0f} %</translation>
    </message>
    <message>
        <source>it continues automatically</source>
        <translation>sie läuft von selbst weiter</translation>
    </message>
    <message>
        <source>{moved}; Resume asks how to continue.</source>
        <translation>{moved}; Weiter fragt, wie es weitergehen soll.</translation>
    </message>
    <message>
        <source>{stopped}. Resume continues from here.</source>
        <translation>{stopped}. Weiter setzt von hier fort.</translation>
    </message>
    <message>
        <source>At rest; Resume continues from here, End ends the playback.</source>
        <translation>In Ruhe; Weiter setzt von hier fort, Ende beendet die Wiedergabe.</translation>
    </message>
    <message>
        <source>Paused at row {row}</source>
        <translation>Pause in Zeile {row}</translation>
    </message>
    <message>
        <source>Link lost</source>
        <translation>Verbindung verloren</translation>
    </message>
    <message>
        <source>The device failed; reconnect it.</source>
        <translation>Das Gerät ist ausgefallen; wieder verbinden.</translation>
    </message>
    <message>
        <source>Failed</source>
        <translation>Ausgefallen</translation>
    </message>
    <message>
        <source>No answer for {time}; the machine may have moved</source>
        <translation>Keine Antwort seit {time}; die Maschine kann sich bewegt haben</translation>
    </message>
    <message>
        <source>Disconnected</source>
        <translation>Getrennt</translation>
    </message>
    <message>
        <source>No machine is connected; nothing can be moved from here.</source>
        <translation>Keine Maschine ist verbunden; von hier lässt sich nichts bewegen.</translation>
    </message>
    <message>
        <source>Connecting</source>
        <translation>Verbindet</translation>
    </message>
    <message>
        <source>Waiting for the first answer of the device.</source>
        <translation>Wartet auf die erste Antwort des Geräts.</translation>
    </message>
    <message>
        <source>No answer for {time}; commands are refused until it answers.</source>
        <translation>Keine Antwort seit {time}; Befehle werden abgelehnt, bis das Gerät antwortet.</translation>
    </message>
    <message>
        <source>The device reports a fault</source>
        <translation>Das Gerät meldet einen Fehler</translation>
    </message>
    <message>
        <source>{fault}. The machine is locked as well: release it first.</source>
        <translation>{fault}. Die Maschine ist auch gesperrt: erst freigeben.</translation>
    </message>
    <message>
        <source>{fault}. Check the machine, then clear the fault.</source>
        <translation>{fault}. Die Maschine prüfen, dann den Fehler quittieren.</translation>
    </message>
    <message>
        <source>Fault</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>The axes are still coming to rest.</source>
        <translation>Die Achsen kommen noch zur Ruhe.</translation>
    </message>
    <message>
        <source>Locked by the operator at {time}. Release it to move.</source>
        <translation>Vom Bediener um {time} gesperrt. Erst freigeben.</translation>
    </message>
    <message>
        <source>Locked by the program at {time}. Release it to move.</source>
        <translation>Vom Programm um {time} gesperrt. Erst freigeben.</translation>
    </message>
    <message>
        <source>{reason} is active. Release it to move.</source>
        <translation>{reason} ist aktiv. Erst freigeben.</translation>
    </message>
    <message>
        <source>Locked</source>
        <translation>Gesperrt</translation>
    </message>
    <message>
        <source>The playback is being paused; the axes are coming to rest.</source>
        <translation>Die Wiedergabe wird angehalten; die Achsen kommen zur Ruhe.</translation>
    </message>
    <message>
        <source>The axes are coming to rest.</source>
        <translation>Die Achsen kommen zur Ruhe.</translation>
    </message>
    <message>
        <source>Stopping</source>
        <translation>Hält an</translation>
    </message>
    <message>
        <source>Moving to find the limit switches of {axes}.</source>
        <translation>Fährt und sucht die Endschalter von {axes}.</translation>
    </message>
    <message>
        <source>Moving to find the limit switches.</source>
        <translation>Fährt und sucht die Endschalter.</translation>
    </message>
    <message>
        <source>Homing</source>
        <translation>Referenzfahrt</translation>
    </message>
    <message>
        <source>The path is being checked; then the axes move.</source>
        <translation>Die Bahn wird geprüft; dann fahren die Achsen.</translation>
    </message>
    <message>
        <source>The axes are moving to the start of the trajectory.</source>
        <translation>Die Achsen fahren zum Anfang der Trajektorie.</translation>
    </message>
    <message>
        <source>{movers}; {time} left</source>
        <translation>{movers}; noch {time}</translation>
    </message>
    <message>
        <source>A trajectory moves the axes</source>
        <translation>Eine Trajektorie bewegt die Achsen</translation>
    </message>
    <message>
        <source>Moving back slowly to row {row}; then the playback resumes.</source>
        <translation>Fährt langsam zu Zeile {row} zurück; dann geht die Wiedergabe weiter.</translation>
    </message>
    <message>
        <source>The machine moves without a command from this window; STOP halts it.</source>
        <translation>Die Maschine bewegt sich ohne Befehl aus diesem Fenster; HALT hält sie an.</translation>
    </message>
    <message>
        <source>Moving</source>
        <translation>Bewegt sich</translation>
    </message>
    <message>
        <source>the position is not known yet</source>
        <translation>die Position ist noch nicht bekannt</translation>
    </message>
    <message>
        <source>its button starts the run</source>
        <translation>ihre Taste startet den Lauf</translation>
    </message>
    <message>
        <source>it stays here until its axes are freed</source>
        <translation>sie bleibt hier, bis ihre Achsen frei sind</translation>
    </message>
    <message>
        <source>Penetration</source>
        <translation>Penetration</translation>
    </message>
    <message>
        <source>{procedure} is under way and moves axes by itself.</source>
        <translation>{procedure} läuft und bewegt Achsen von selbst.</translation>
    </message>
    <message>
        <source>A command is about to begin.</source>
        <translation>Ein Befehl beginnt gleich.</translation>
    </message>
    <message>
        <source>It resumes as soon as the axes rest and the path is checked.</source>
        <translation>Es geht weiter, sobald die Achsen ruhen und die Bahn geprüft ist.</translation>
    </message>
    <message>
        <source>{excess}. Check the machine, then resume or end.</source>
        <translation>{excess}. Die Maschine prüfen, dann Weiter oder Ende.</translation>
    </message>
    <message>
        <source>{stopped}. The next command moves it again.</source>
        <translation>{stopped}. Der nächste Befehl bewegt sie wieder.</translation>
    </message>
    <message>
        <source>Stopped</source>
        <translation>Angehalten</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>Bereit</translation>
    </message>
    <message>
        <source>At rest; every axis can be moved.</source>
        <translation>In Ruhe; jede Achse lässt sich bewegen.</translation>
    </message>
    <message>
        <source>{moving}. No new command is accepted: {reason}</source>
        <translation>{moving}. Kein neuer Befehl wird angenommen: {reason}</translation>
    </message>
    <message>
        <source>{owner} moves {axes}</source>
        <translation>{owner} bewegt {axes}</translation>
    </message>
    <message>
        <source>Not known: the machine does not answer.</source>
        <translation>Unbekannt: die Maschine antwortet nicht.</translation>
    </message>
    <message>
        <source>Axes are moving.</source>
        <translation>Achsen bewegen sich.</translation>
    </message>
    <message>
        <source>No axis is moving.</source>
        <translation>Keine Achse bewegt sich.</translation>
    </message>
    <message>
        <source>Stopped by the operator at {time}</source>
        <translation>Vom Bediener um {time} angehalten</translation>
    </message>
    <message>
        <source>Stopped by the program at {time}</source>
        <translation>Vom Programm um {time} angehalten</translation>
    </message>
    <message>
        <source>{axis} moved {distance}</source>
        <translation>{axis} um {distance} bewegt</translation>
    </message>
    <message>
        <source>{parts} since the pause</source>
        <translation>Seit der Pause {parts}</translation>
    </message>
    <message>
        <source>all axes</source>
        <translation>alle Achsen</translation>
    </message>
    <message>
        <source>Phase of the session</source>
        <translation>Phase der Sitzung</translation>
    </message>
    <message>
        <source>{doing} About {left} left.</source>
        <translation>{doing} Noch etwa {left}.</translation>
    </message>
    <message>
        <source>{doing} Cancelled; nothing was changed.</source>
        <translation>{doing} Abgebrochen; nichts wurde geändert.</translation>
    </message>
    <message>
        <source>{doing} Running for {passed}.</source>
        <translation>{doing} Läuft seit {passed}.</translation>
    </message>
    <message>
        <source>Progress of long work</source>
        <translation>Fortschritt langer Arbeit</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Cancel this work</source>
        <translation>Diese Arbeit abbrechen</translation>
    </message>
    <message>
        <source>No one is driving</source>
        <translation>Niemand steuert</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>● Not recording: disk</source>
        <translation>● Keine Aufnahme: Datenträger</translation>
    </message>
    <message>
        <source>● {time}  {size}</source>
        <translation>● {time}  {size}</translation>
    </message>
    <message>
        <source>Warnings {n}</source>
        <translation>Warnungen {n}</translation>
    </message>
    <message>
        <source>Phase in the recording</source>
        <translation>Phase in der Aufnahme</translation>
    </message>
    <message>
        <source>Back to live</source>
        <translation>Zurück zu live</translation>
    </message>
    <message>
        <source>Resume or pause the replay</source>
        <translation>Wiedergabe fortsetzen oder anhalten</translation>
    </message>
    <message>
        <source>Time of the replay and its length</source>
        <translation>Zeit der Wiedergabe und ihre Länge</translation>
    </message>
    <message>
        <source>Replay, not the machine: {stem}</source>
        <translation>Wiedergabe, nicht die Maschine: {stem}</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Replay speed as a multiple of real time</source>
        <translation>Wiedergabegeschwindigkeit als Vielfaches der Echtzeit</translation>
    </message>
    <message>
        <source>Connect …</source>
        <translation>Verbinden …</translation>
    </message>
    <message>
        <source>Simulator</source>
        <translation>Simulator</translation>
    </message>
    <message>
        <source>Load example</source>
        <translation>Beispiel</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>Diagnose</source>
        <translation>Diagnose</translation>
    </message>
    <message>
        <source>Close this card permanently</source>
        <translation>Diese Karte dauerhaft schließen</translation>
    </message>
    <message>
        <source>a trajectory is paused; resume or end it</source>
        <translation>eine Trajektorie ist angehalten; erst Weiter oder Ende</translation>
    </message>
    <message>
        <source>Find out why model and machine differ</source>
        <translation>Herausfinden, warum Modell und Maschine voneinander abweichen</translation>
    </message>
    <message>
        <source>Esc stops</source>
        <translation>Esc hält an</translation>
    </message>
    <message>
        <source>example</source>
        <translation>Beispiel</translation>
    </message>
    <message>
        <source>Speed of the replay</source>
        <translation>Tempo der Wiedergabe</translation>
    </message>
    <message>
        <source>{name} cannot be shown: a penetration is {phase}; end it first</source>
        <translation>{name} kann nicht gezeigt werden: eine Penetration läuft ({phase}); erst beenden</translation>
    </message>
    <message>
        <source>data {age} old</source>
        <translation>Daten {age} alt</translation>
    </message>
    <message>
        <source>stop latency {ms:.1f} ms (99.9 %)</source>
        <translation>Halt nach {ms:.1f} ms (99,9 %)</translation>
    </message>
    <message>
        <source>last stop {ms:.1f} ms</source>
        <translation>letzter Halt {ms:.1f} ms</translation>
    </message>
    <message>
        <source>Messages of the program since its start</source>
        <translation>Meldungen des Programms seit dem Start</translation>
    </message>
    <message>
        <source>Versions of the program, its libraries and plugins</source>
        <translation>Versionen des Programms, seiner Bibliotheken und Plugins</translation>
    </message>
    <message>
        <source>The last record: commands and readings</source>
        <translation>Die letzte Aufzeichnung: Sollwerte und Messwerte</translation>
    </message>
    <message>
        <source>Support bundle</source>
        <translation>Support-Paket</translation>
    </message>
    <message>
        <source>Save …</source>
        <translation>Speichern …</translation>
    </message>
    <message>
        <source>Files of the bundle</source>
        <translation>Dateien des Pakets</translation>
    </message>
    <message>
        <source>Content of the file</source>
        <translation>Inhalt der Datei</translation>
    </message>
    <message>
        <source>Save support bundle</source>
        <translation>Support-Paket speichern</translation>
    </message>
    <message>
        <source>Archives (*.zip)</source>
        <translation>Archive (*.zip)</translation>
    </message>
    <message>
        <source>Pages (*.html)</source>
        <translation>Seiten (*.html)</translation>
    </message>
    <message>
        <source>Run report …</source>
        <translation>Laufbericht …</translation>
    </message>
    <message>
        <source>Write a page with date, machine, model, plots, gap, events and note of the run, and open it</source>
        <translation>Eine Seite mit Datum, Maschine, Modell, Kurven, Abweichung, Ereignissen und Notiz des Laufs schreiben und öffnen</translation>
    </message>
    <message>
        <source>{path}: no program is set up to open it; open it in a browser</source>
        <translation>{path}: kein Programm ist zum Öffnen eingerichtet; öffnen Sie die Datei in einem Browser</translation>
    </message>
    <message>
        <source>Saved {path}</source>
        <translation>Gespeichert: {path}</translation>
    </message>
    <message>
        <source>Run report</source>
        <translation>Laufbericht</translation>
    </message>
    <message>
        <source>The support bundle is being assembled.</source>
        <translation>Das Support-Paket wird zusammengestellt.</translation>
    </message>
    <message>
        <source>the bundle is still being assembled</source>
        <translation>das Paket wird noch zusammengestellt</translation>
    </message>
    <message>
        <source>Time of the replay</source>
        <translation>Zeit der Wiedergabe</translation>
    </message>
    <message>
        <source>Switching the model …</source>
        <translation>Modell wird gewechselt …</translation>
    </message>
    <message>
        <source>There is no trajectory to play: load one first.</source>
        <translation>Es gibt keine Trajektorie zum Abspielen: erst eine laden.</translation>
    </message>
    <message>
        <source>Reading {name} …</source>
        <translation>{name} wird gelesen …</translation>
    </message>
    <message>
        <source>Dry run …</source>
        <translation>Probelauf am Modell …</translation>
    </message>
    <message>
        <source>There is no record to save: play or open one first.</source>
        <translation>Es gibt keine Aufzeichnung zum Speichern: erst eine abspielen oder öffnen.</translation>
    </message>
    <message>
        <source>Writing {name} …</source>
        <translation>{name} wird geschrieben …</translation>
    </message>
    <message>
        <source>Opening {name} …</source>
        <translation>{name} wird geöffnet …</translation>
    </message>
    <message>
        <source>Not played: {why}. Press Play again.</source>
        <extracomment>Reported when a request to play is withdrawn before it had an effect.</extracomment>
        <translation>Nicht abgespielt: {why}. Noch einmal auf Abspielen drücken.</translation>
    </message>
    <message>
        <source>the dry run of {name} has not ended yet</source>
        <translation>der Probelauf von {name} ist noch nicht zu Ende</translation>
    </message>
    <message>
        <source>the playback is being resumed</source>
        <translation>die Wiedergabe wird gerade fortgesetzt</translation>
    </message>
    <message>
        <source>Not done: {why}.</source>
        <translation>Nicht ausgeführt: {why}.</translation>
    </message>
    <message>
        <source>Not played: nothing limits the speed of an axis, and the panel Trajectory, which asks for a limit, is missing. State a limit in the robot file.</source>
        <translation>Nicht abgespielt: nichts begrenzt die Geschwindigkeit einer Achse, und das Fenster Trajektorie, das nach einer Grenze fragt, fehlt. Die Grenze in der Roboterdatei angeben.</translation>
    </message>
    <message>
        <source>another trajectory was loaded meanwhile</source>
        <translation>inzwischen wurde eine andere Trajektorie geladen</translation>
    </message>
    <message>
        <source>Replaced by a newer request: {doing}</source>
        <translation>Durch eine neuere Anforderung ersetzt: {doing}</translation>
    </message>
    <message>
        <source>The recording is being merged into one file.</source>
        <translation>Die Aufnahme wird zu einer Datei zusammengefasst.</translation>
    </message>
    <message>
        <source>Playback paused: {text}. Check the machine, then resume or end the playback.</source>
        <translation>Wiedergabe pausiert: {text}. Die Maschine prüfen, dann fortsetzen oder beenden.</translation>
    </message>
    <message>
        <source>The nominal model is in use again: {why}.</source>
        <translation>Das Nominalmodell wird wieder verwendet: {why}.</translation>
    </message>
    <message>
        <source>{name}: stopped before its first row was played.</source>
        <translation>{name}: angehalten, bevor die erste Zeile abgespielt war.</translation>
    </message>
    <message>
        <source>{name}: stopped after {duration_s:.2f} s.</source>
        <translation>{name}: nach {duration_s:.2f} s angehalten.</translation>
    </message>
    <message>
        <source>Comparing model and machine …</source>
        <translation>Modell und Maschine werden verglichen …</translation>
    </message>
    <message>
        <source>System language</source>
        <translation>Sprache des Systems</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Sprache</translation>
    </message>
    <message>
        <source>La&amp;nguage</source>
        <translation>Sp&amp;rache</translation>
    </message>
    <message>
        <source>Panel {name!r} is left out: it cannot be drawn: {error}</source>
        <translation>Panel {name!r} wird ausgelassen: es lässt sich nicht zeichnen: {error}</translation>
    </message>
    <message>
        <source>Panel {name!r} is left out after {n} faults: {error}</source>
        <translation>Das Panel {name!r} fehlt nach {n} Fehlern: {error}</translation>
    </message>
    <message>
        <source>Panel {name!r} has failed: {error}</source>
        <translation>Das Panel {name!r} hat einen Fehler gemeldet: {error}</translation>
    </message>
    <message>
        <source>Gap, last 10 s</source>
        <translation>Abweichung, letzte 10 s</translation>
    </message>
    <message>
        <source>Gap, this run</source>
        <translation>Abweichung, dieser Lauf</translation>
    </message>
    <message>
        <source>without offset {without} · nominal {nominal}</source>
        <translation>ohne Versatz {without} · nominal {nominal}</translation>
    </message>
    <message>
        <source>Model in use</source>
        <translation>Verwendetes Modell</translation>
    </message>
    <message>
        <source>Back to nominal</source>
        <translation>Zurück zum Nominalmodell</translation>
    </message>
    <message>
        <source>The model that plots, comparison, dry run and 3-D view use.</source>
        <translation>Das Modell, das Diagramme, Vergleich, Probelauf und 3-D-Ansicht verwenden.</translation>
    </message>
    <message>
        <source>Nominal model</source>
        <translation>Nominalmodell</translation>
    </message>
    <message>
        <source>Corrected: {effects}</source>
        <translation>Korrigiert: {effects}</translation>
    </message>
    <message>
        <source>SIMULATOR</source>
        <extracomment>A device is being opened that has not identified itself yet. Kinds that may be a real machine. They are drawn alike.</extracomment>
        <translation>SIMULATOR</translation>
    </message>
    <message>
        <source>VIRTUAL BOARDS</source>
        <translation>VIRTUELLE KARTEN</translation>
    </message>
    <message>
        <source>MACHINE</source>
        <translation>MASCHINE</translation>
    </message>
    <message>
        <source>CONNECTING …</source>
        <translation>VERBINDET …</translation>
    </message>
    <message>
        <source>The device has not said yet what it is: treat it as a real machine.</source>
        <translation>Das Gerät hat noch nicht gemeldet, was es ist: wie eine echte Maschine behandeln.</translation>
    </message>
    <message>
        <source>nominal</source>
        <translation>nominal</translation>
    </message>
    <message>
        <source>worn: {axes}</source>
        <translation>verschlissen: {axes}</translation>
    </message>
    <message>
        <source>About RoTeMiNa</source>
        <translation>Über RoTeMiNa</translation>
    </message>
    <message>
        <source>Licence: MIT
Robot: {robot}
Driver: {driver}
Python {python}, Qt {qt}
Records: {records}
Preferences: {settings}</source>
        <translation>Lizenz: MIT
Roboter: {robot}
Treiber: {driver}
Python {python}, Qt {qt}
Aufzeichnungen: {records}
Einstellungen: {settings}</translation>
    </message>
    <message>
        <source>Recent &amp;files</source>
        <translation>Zuletzt verwendete &amp;Dateien</translation>
    </message>
    <message>
        <source>Who moves the machine</source>
        <translation>Wer die Maschine bewegt</translation>
    </message>
    <message>
        <source>Open or close this panel</source>
        <translation>Dieses Panel öffnen oder schließen</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>Other file …</source>
        <translation>Andere Datei …</translation>
    </message>
    <message>
        <source>Search</source>
        <translation>Suchen</translation>
    </message>
    <message>
        <source>Search the records</source>
        <translation>Die Aufzeichnungen durchsuchen</translation>
    </message>
    <message>
        <source>Words of name, note, run, operator, sample, machine, model, effects, date or file</source>
        <translation>Wörter aus Name, Notiz, Lauf, Bediener, Probe, Maschine, Modell, Effekten, Datum oder Datei</translation>
    </message>
    <message>
        <source>Kind of the records</source>
        <translation>Art der Aufzeichnungen</translation>
    </message>
    <message>
        <source>All records</source>
        <translation>Alle Aufzeichnungen</translation>
    </message>
    <message>
        <source>Records, newest first</source>
        <translation>Aufzeichnungen, neueste zuerst</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Recorded</source>
        <translation>Aufgenommen</translation>
    </message>
    <message>
        <source>Length</source>
        <translation>Länge</translation>
    </message>
    <message>
        <source>Gap</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Sample</source>
        <translation>Probe</translation>
    </message>
    <message>
        <source>Operator</source>
        <translation>Bediener</translation>
    </message>
    <message>
        <source>Effects</source>
        <translation>Effekte</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>File</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>playback</source>
        <translation>Wiedergabe</translation>
    </message>
    <message>
        <source>Playbacks</source>
        <translation>Wiedergaben</translation>
    </message>
    <message>
        <source>recording</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Recordings</source>
        <translation>Aufnahmen</translation>
    </message>
    <message>
        <source>file</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>cannot be opened: {problem}</source>
        <translation>lässt sich nicht öffnen: {problem}</translation>
    </message>
    <message>
        <source>The file has changed since it was listed</source>
        <translation>Die Datei hat sich seit dem Eintrag geändert</translation>
    </message>
    <message>
        <source>Run: {run}</source>
        <translation>Lauf: {run}</translation>
    </message>
    <message>
        <source>Events: {n}</source>
        <translation>Ereignisse: {n}</translation>
    </message>
    <message>
        <source>there is no previous page</source>
        <translation>es gibt keine vorige Seite</translation>
    </message>
    <message>
        <source>Previous page (Alt+Left)</source>
        <translation>Vorige Seite (Alt+Links)</translation>
    </message>
    <message>
        <source># No such page

The program has no page {name!r}. [All pages]</source>
        <translation># Keine solche Seite

Das Programm enthält keine Seite {name!r}. [Alle Seiten]</translation>
    </message>
    <message>
        <source>The program does not contain {address}; see the folder docs of its source, or the site that `make docs` builds.</source>
        <translation>Das Programm enthält {address} nicht; siehe den Ordner docs der Quellen oder die Seiten, die `make docs` erzeugt.</translation>
    </message>
    <message>
        <source>Stop all axes and hold their positions; a software stop</source>
        <translation>Alle Achsen anhalten und ihre Position halten; ein Halt durch Software</translation>
    </message>
    <message>
        <source>Stop and lock: nothing moves until release; a software stop</source>
        <translation>Halt und sperren: bis zur Freigabe bewegt sich nichts; ein Halt durch Software</translation>
    </message>
    <message>
        <source>Release the lock; nothing moves by itself</source>
        <translation>Die Sperre lösen; von selbst bewegt sich nichts</translation>
    </message>
    <message>
        <source>Find the limit switches of all axes with switches; these axes move</source>
        <translation>Die Endschalter aller Achsen suchen, die welche haben; diese Achsen bewegen sich</translation>
    </message>
    <message>
        <source>Operate the machine: control, job, events, trajectory, penetration, recorder</source>
        <translation>Die Maschine bedienen: Steuerung, Auftrag, Ereignisse, Trajektorie, Penetration, Rekorder</translation>
    </message>
    <message>
        <source>Find out why machine and model differ: gap, comparison, effects</source>
        <translation>Herausfinden, warum die Maschine vom Modell abweicht: Abweichung, Vergleich, Effekte</translation>
    </message>
    <message>
        <source>enter a name</source>
        <translation>einen Namen eingeben</translation>
    </message>
    <message>
        <source>the name has {n} letters; at most {most} are possible</source>
        <translation>der Name hat {n} Zeichen; höchstens {most} sind möglich</translation>
    </message>
    <message>
        <source>{n} layouts, the maximum, are saved; delete one first</source>
        <translation>{n} Anordnungen, die Höchstzahl, sind gespeichert; erst eine löschen</translation>
    </message>
    <message>
        <source>Meaning and remedy: {page}</source>
        <translation>Bedeutung und Abhilfe: {page}</translation>
    </message>
    <message>
        <source>driver {name!r} cannot be created: {kind}: {error}</source>
        <translation>Treiber {name!r} lässt sich nicht anlegen: {kind}: {error}</translation>
    </message>
    <message>
        <source>The axes are still moving: stop them before you choose the simulator.</source>
        <translation>Die Achsen bewegen sich noch: erst anhalten, dann den Simulator wählen.</translation>
    </message>
    <message>
        <source>select a record in the table</source>
        <translation>eine Aufzeichnung in der Tabelle wählen</translation>
    </message>
    <message>
        <source>Use the selected records</source>
        <translation>Die gewählten Aufzeichnungen benutzen</translation>
    </message>
    <message>
        <source>Gap from the model in use at that time, of the axis with the most noise floors</source>
        <translation>Abweichung vom damals verwendeten Modell, von der Achse mit den meisten Rauschgrenzen</translation>
    </message>
    <message>
        <source>Kind of records to list</source>
        <translation>Art der aufgelisteten Aufzeichnungen</translation>
    </message>
    <message>
        <source>Storing {name} …</source>
        <translation>{name} wird gespeichert …</translation>
    </message>
    <message>
        <source>The built-in simulator: no real machine moves.</source>
        <translation>Der eingebaute Simulator: keine echte Maschine bewegt sich.</translation>
    </message>
    <message>
        <source>Boards that identify themselves as emulated: no real machine moves.</source>
        <translation>Karten, die sich als nachgebildet melden: keine echte Maschine bewegt sich.</translation>
    </message>
    <message>
        <source>Commands of this window move a real machine.</source>
        <translation>Befehle dieses Fensters bewegen eine echte Maschine.</translation>
    </message>
    <message>
        <source>Other files</source>
        <translation>Andere Dateien</translation>
    </message>
    <message>
        <source>The file is missing: delete the entry, or find the file</source>
        <translation>Die Datei fehlt: den Eintrag löschen oder die Datei suchen</translation>
    </message>
    <message>
        <source>No layout is saved</source>
        <translation>Keine gespeichert</translation>
    </message>
    <message>
        <source>Display preferences, and driver settings</source>
        <translation>Einstellungen der Anzeige und der Treiber</translation>
    </message>
    <message>
        <source>Robot, driver and state of the connection</source>
        <translation>Roboter, Treiber und Zustand der Verbindung</translation>
    </message>
    <message>
        <source>Delays of the window; the log names their causes</source>
        <translation>Verzögerungen des Fensters; das Protokoll nennt ihre Ursachen</translation>
    </message>
    <message>
        <source>its panel does not permit it now</source>
        <translation>sein Panel lässt es jetzt nicht zu</translation>
    </message>
    <message>
        <source>State of the machine at that time; the tool bar shows the present state</source>
        <translation>Damaliger Zustand der Maschine; die Werkzeugleiste zeigt den aktuellen</translation>
    </message>
    <message>
        <source>The machine is moving now</source>
        <translation>Die Maschine bewegt sich</translation>
    </message>
    <message>
        <source>Show the machine again and permit motion</source>
        <translation>Wieder die Maschine zeigen und Bewegung zulassen</translation>
    </message>
    <message>
        <source>Time of the recording. Marks, by importance: faults; stops, refusals and warnings; others</source>
        <translation>Zeit der Aufnahme. Marken nach Wichtigkeit: Fehler; Halte, Ablehnungen und Warnungen; andere</translation>
    </message>
    <message>
        <source>{doing} Cancelling.</source>
        <translation>{doing} Wird abgebrochen.</translation>
    </message>
    <message>
        <source>Predictions only: commands to the machine do not change. The panel Compensation changes them.</source>
        <translation>Nur Vorhersagen: Sollwerte an die Maschine ändern sich nicht. Das tut das Panel Kompensation.</translation>
    </message>
    <message>
        <source>≈ The history of {axes} is unknown: until it has swept its range, the model may be off by the band in the plots.</source>
        <translation>≈ Die Vorgeschichte von {axes} ist unbekannt: bis der ganze Bereich einmal durchfahren ist, kann das Modell um das Band in den Diagrammen danebenliegen.</translation>
    </message>
    <message>
        <source>the axes are still moving</source>
        <translation>die Achsen bewegen sich noch</translation>
    </message>
    <message>
        <source>The simulator moves no real machine</source>
        <translation>Der Simulator bewegt keine echte Maschine</translation>
    </message>
    <message>
        <source>A trajectory for this robot, checked on the model first</source>
        <translation>Eine Trajektorie für diesen Roboter, zuerst am Modell geprüft</translation>
    </message>
    <message>
        <source>Load the commands of a record of the library</source>
        <translation>Die Sollwerte einer Aufzeichnung der Bibliothek laden</translation>
    </message>
    <message>
        <source>there is no previous position</source>
        <translation>es gibt keine frühere Position</translation>
    </message>
    <message>
        <source>already connected</source>
        <translation>schon verbunden</translation>
    </message>
    <message>
        <source>Stop all axes and hold their positions (Esc)</source>
        <translation>Alle Achsen anhalten und ihre Position halten (Esc)</translation>
    </message>
    <message>
        <source>Locks until release (Shift+Esc)</source>
        <translation>Sperrt bis zur Freigabe (Umschalt+Esc)</translation>
    </message>
    <message>
        <source>&amp;Back to the previous position</source>
        <translation>&amp;Zurück zur vorigen Position</translation>
    </message>
    <message>
        <source>Acknowledge the fault</source>
        <translation>Den Fehler quittieren</translation>
    </message>
    <message>
        <source>Save the layout under a name</source>
        <translation>Die Anordnung unter einem Namen speichern</translation>
    </message>
    <message>
        <source>Restore all panels</source>
        <translation>Alle Panels zurücksetzen</translation>
    </message>
    <message>
        <source>Log, settings, versions and record for support</source>
        <translation>Protokoll, Einstellungen, Versionen und Aufzeichnung für den Support</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Keine</translation>
    </message>
    <message>
        <source>Reaction time of the window since its start. The log names the cause of any delay above a quarter of a second.</source>
        <translation>Reaktionszeit des Fensters seit dem Start. Das Protokoll nennt die Ursache jeder Verzögerung über einer Viertelsekunde.</translation>
    </message>
    <message>
        <source>Copy the selected messages, or all displayed ones</source>
        <translation>Die gewählten Meldungen kopieren oder alle gezeigten</translation>
    </message>
    <message>
        <source>Messages to show</source>
        <translation>Gezeigte Meldungen</translation>
    </message>
    <message>
        <source>Words to search for in the messages</source>
        <translation>Wörter, nach denen die Meldungen durchsucht werden</translation>
    </message>
    <message>
        <source>Help on the selected message</source>
        <translation>Hilfe zur gewählten Meldung</translation>
    </message>
    <message>
        <source>select one message</source>
        <translation>eine Meldung wählen</translation>
    </message>
    <message>
        <source>Meaning of the message: {page}</source>
        <translation>Bedeutung der Meldung: {page}</translation>
    </message>
    <message>
        <source>The preferences were reset: {fault}. The old file is kept as {path}.</source>
        <translation>Die Einstellungen wurden zurückgesetzt: {fault}. Die alte Datei bleibt als {path} erhalten.</translation>
    </message>
    <message>
        <source>No range is limited: {error}. Set the limits again in Control, Axes.</source>
        <translation>Kein Bereich ist begrenzt: {error}. Die Grenzen unter Steuerung, Achsen neu setzen.</translation>
    </message>
    <message>
        <source>The preferences were reset and cannot be saved: {fault}. Move that file away.</source>
        <translation>Die Einstellungen wurden zurückgesetzt und lassen sich nicht speichern: {fault}. Diese Datei verschieben.</translation>
    </message>
    <message>
        <source>The bundle will contain these files. User names, home folders and the name of this computer are already removed. Nothing is sent: you choose where the archive is saved.</source>
        <translation>Diese Dateien wird das Paket enthalten. Benutzernamen, Heimatordner und der Name dieses Rechners sind schon entfernt. Nichts wird gesendet: das Archiv wird am gewählten Ort gespeichert.</translation>
    </message>
    <message>
        <source>The support bundle is being written.</source>
        <translation>Das Support-Paket wird geschrieben.</translation>
    </message>
    <message>
        <source>Write all files into one zip archive</source>
        <translation>Alle Dateien in ein Zip-Archiv schreiben</translation>
    </message>
    <message>
        <source>Who moves the machine: each moving axis has one owner</source>
        <translation>Wer die Maschine bewegt: jede bewegte Achse hat einen Besitzer</translation>
    </message>
    <message>
        <source>Nobody at present.</source>
        <translation>Zurzeit niemand.</translation>
    </message>
    <message>
        <source>no motion</source>
        <translation>keine Bewegung</translation>
    </message>
    <message>
        <source>The record of the last playback is not saved: quitting now loses it. To save it, stay and press Ctrl+S.</source>
        <translation>Die Aufzeichnung der letzten Wiedergabe ist nicht gespeichert: Beenden verliert sie. Zum Speichern bleiben und Strg+S drücken.</translation>
    </message>
    <message>
        <source>A trajectory is playing. Quitting stops it and keeps the record so far.</source>
        <translation>Eine Trajektorie wird abgespielt. Beenden hält sie an und behält die bisherige Aufzeichnung.</translation>
    </message>
    <message>
        <source>Stop all axes and block motion until release (Shift+Esc).</source>
        <translation>Alle Achsen anhalten und Bewegung bis zur Freigabe sperren (Umschalt+Esc).</translation>
    </message>
    <message>
        <source>Press to release; nothing moves without a command.</source>
        <translation>Drücken gibt frei; ohne Befehl bewegt sich nichts.</translation>
    </message>
    <message>
        <source>Stop all axes and hold their positions (Esc); a second press within 1 s locks.</source>
        <translation>Alle Achsen anhalten und halten (Esc); ein zweiter Druck innerhalb von 1 s sperrt.</translation>
    </message>
    <message>
        <source>The file has no header. Choose the content of each column:</source>
        <translation>Die Datei hat keine Kopfzeile. Den Inhalt jeder Spalte wählen:</translation>
    </message>
    <message>
        <source>Playbacks occupy {size}, more than {most} GB (preference {key}). The program deletes none of them: delete unneeded ones in the panel Recorder.</source>
        <translation>Wiedergaben belegen {size}, mehr als {most} GB (Einstellung {key}). Das Programm löscht keine: nicht mehr benötigte im Panel Rekorder löschen.</translation>
    </message>
    <message>
        <source>Only {free} are free on the disk of the records; playbacks occupy {size}. The program deletes none of them: delete unneeded ones in the panel Recorder.</source>
        <translation>Nur {free} sind frei auf dem Datenträger der Aufzeichnungen; Wiedergaben belegen {size}. Das Programm löscht keine: nicht mehr benötigte im Panel Rekorder löschen.</translation>
    </message>
    <message>
        <source>{parent}: cannot be created: {strerror}</source>
        <translation>{parent}: lässt sich nicht anlegen: {strerror}</translation>
    </message>
    <message>
        <source>Program error: {error}. The log has details; please save a support bundle.</source>
        <extracomment>Faults in slots and timers after which a panel is removed.</extracomment>
        <translation>Programmfehler: {error}. Das Protokoll enthält Einzelheiten; bitte ein Support-Paket speichern.</translation>
    </message>
    <message>
        <source>Time and size of the running recording</source>
        <translation>Dauer und Größe der laufenden Aufnahme</translation>
    </message>
    <message>
        <source>program error: {name}: {error}</source>
        <translation>Programmfehler: {name}: {error}</translation>
    </message>
    <message>
        <source>{name}: recorded with another robot file; ranges and scales on the screen are those of this window</source>
        <translation>{name}: mit einer anderen Roboterdatei aufgenommen; Bereiche und Skalen sind die dieses Fensters</translation>
    </message>
    <message>
        <source>a replay of {name} is displayed; go back to live first</source>
        <translation>eine Wiedergabe von {name} wird gezeigt; erst zurück zu live</translation>
    </message>
    <message>
        <source>{name}: recorded on robot {robot!r} with axes {axes}, but the robot of this window has {here}. Start a window for that robot: rotemina recording info --robot-file {path} &gt; {file} &amp;&amp; rotemina --robot {file}</source>
        <translation>{name}: aufgenommen am Roboter {robot!r} mit den Achsen {axes}, aber der Roboter dieses Fensters hat {here}. Ein Fenster für diesen Roboter starten: rotemina recording info --robot-file {path} &gt; {file} &amp;&amp; rotemina --robot {file}</translation>
    </message>
    <message>
        <source>{name} cannot be shown: the machine is moving; wait, or stop it first</source>
        <translation>{name} kann nicht gezeigt werden: die Maschine bewegt sich; warten oder erst anhalten</translation>
    </message>
    <message>
        <source>RoTeMiNa {version}
Operator&apos;s window of a hybrid robot for cell manipulation, with diagnosis of the gap between model and machine.</source>
        <translation>RoTeMiNa {version}
Bedienfenster eines hybriden Roboters zur Zellmanipulation, mit Diagnose der Abweichung zwischen Modell und Maschine.</translation>
    </message>
    <message>
        <source>The layout {name!r} cannot be read; delete it and save it again.</source>
        <translation>Die Anordnung {name!r} ist nicht lesbar; löschen und neu speichern.</translation>
    </message>
    <message>
        <source>the connection has changed meanwhile</source>
        <translation>die Verbindung hat sich inzwischen geändert</translation>
    </message>
    <message>
        <source>a stop came meanwhile</source>
        <translation>inzwischen kam ein Halt</translation>
    </message>
    <message>
        <source>the lock was released meanwhile</source>
        <translation>die Sperre wurde inzwischen freigegeben</translation>
    </message>
    <message>
        <source>a request waits until the machine is at rest</source>
        <translation>eine Anforderung wartet, bis die Maschine ruht</translation>
    </message>
    <message>
        <source>Waits until the machine is at rest …</source>
        <translation>Wartet, bis die Maschine ruht …</translation>
    </message>
    <message>
        <source>another request took its place</source>
        <translation>eine andere Anforderung hat sie ersetzt</translation>
    </message>
    <message>
        <source>Move back slowly and resume</source>
        <translation>Langsam zurückfahren und weiter</translation>
    </message>
    <message>
        <source>Move back to the pause position at a tenth of the axes&apos; maximum speed, then resume</source>
        <translation>Mit einem Zehntel der Höchstgeschwindigkeit der Achsen zur Pausenposition zurückfahren, dann fortsetzen</translation>
    </message>
    <message>
        <source>Start over</source>
        <translation>Von vorn beginnen</translation>
    </message>
    <message>
        <source>Play from the first row; the axes first move there</source>
        <translation>Ab der ersten Zeile abspielen; die Achsen fahren zuerst dorthin</translation>
    </message>
    <message>
        <source>Keep paused</source>
        <translation>Angehalten lassen</translation>
    </message>
    <message>
        <source>Move nothing; Resume asks again</source>
        <translation>Nichts bewegen; Weiter fragt noch einmal</translation>
    </message>
    <message>
        <source>{moved}. How do you want to continue?</source>
        <translation>{moved}. Wie möchten Sie fortfahren?</translation>
    </message>
    <message>
        <source>Indicators that do not fit into the header</source>
        <translation>Anzeigen, die nicht in die Kopfzeile passen</translation>
    </message>
</context>
</TS>
