<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
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
        <source>The layout {name!r} cannot be read; delete it and save it anew.</source>
        <translation>Die Anordnung {name!r} ist nicht lesbar; löschen und neu speichern.</translation>
    </message>
    <message>
        <source>a fault of the program: {name}: {error}</source>
        <translation>ein Fehler des Programms: {name}: {error}</translation>
    </message>
    <message>
        <source>Looking at {name} …</source>
        <translation>{name} wird angesehen …</translation>
    </message>
    <message>
        <source>Columns of {name}</source>
        <translation>Spalten von {name}</translation>
    </message>
    <message>
        <source>The file has no header. Say what each column holds:</source>
        <translation>Die Datei hat keinen Kopf. Was steht in welcher Spalte?</translation>
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
        <source>Stop and leave</source>
        <translation>Anhalten und beenden</translation>
    </message>
    <message>
        <source>there is no trajectory; load one first</source>
        <translation>es gibt keine Trajektorie; erst eine laden</translation>
    </message>
    <message>
        <source>the emergency stop is not latched</source>
        <translation>der Not-Halt ist nicht eingerastet</translation>
    </message>
    <message>
        <source>there is no move to take back</source>
        <translation>es gibt keine Bewegung zum Zurücknehmen</translation>
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
        <source>it is connected</source>
        <translation>es ist verbunden</translation>
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
        <source>Stop all axes and hold (Esc)</source>
        <translation>Alle Achsen anhalten und halten (Esc)</translation>
    </message>
    <message>
        <source>&amp;Emergency stop</source>
        <translation>&amp;Not-Halt</translation>
    </message>
    <message>
        <source>Latched (Shift+Esc)</source>
        <translation>Rastet ein (Umschalt+Esc)</translation>
    </message>
    <message>
        <source>Re&amp;lease the emergency stop</source>
        <translation>Not-Halt &amp;freigeben</translation>
    </message>
    <message>
        <source>Let axes move</source>
        <translation>Achsen dürfen sich bewegen</translation>
    </message>
    <message>
        <source>&amp;Back to before the latest move</source>
        <translation>Letzte Bewegung &amp;rückgängig</translation>
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
        <source>Acknowledge it</source>
        <translation>Zur Kenntnis nehmen</translation>
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
        <source>Stop, and let go of it</source>
        <translation>Anhalten und loslassen</translation>
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
        <source>Keep it under a name</source>
        <translation>Unter einem Namen behalten</translation>
    </message>
    <message>
        <source>&amp;Restore the layout</source>
        <translation>Anordnung &amp;zurücksetzen</translation>
    </message>
    <message>
        <source>All docks back</source>
        <translation>Alle Panels zurück</translation>
    </message>
    <message>
        <source>Larger text</source>
        <translation>Größere Schrift</translation>
    </message>
    <message>
        <source>Up to twice</source>
        <translation>Bis zum Doppelten</translation>
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
        <source>By its height</source>
        <translation>Nach seiner Höhe</translation>
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
        <source>By letters</source>
        <translation>Mit Buchstaben</translation>
    </message>
    <message>
        <source>Help on this &amp;panel</source>
        <translation>Hilfe zu diesem &amp;Panel</translation>
    </message>
    <message>
        <source>The one with the focus</source>
        <translation>Dem mit dem Fokus</translation>
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
        <source>All that the program told</source>
        <translation>Alles, was das Programm gemeldet hat</translation>
    </message>
    <message>
        <source>&amp;Support bundle …</source>
        <translation>Support-Pa&amp;ket …</translation>
    </message>
    <message>
        <source>Log, settings, versions and record for those who help</source>
        <translation>Protokoll, Einstellungen, Versionen und Aufzeichnung für Helfende</translation>
    </message>
    <message>
        <source>Not now: {why_not}</source>
        <translation>Nicht jetzt: {why_not}</translation>
    </message>
    <message>
        <source>not connected; connect first</source>
        <translation>nicht verbunden; erst verbinden</translation>
    </message>
    <message>
        <source>connecting; wait</source>
        <translation>wird verbunden; warten</translation>
    </message>
    <message>
        <source>the device failed ({fault}); reconnect, then check where it stands</source>
        <translation>das Gerät ist ausgefallen ({fault}); wieder verbinden, dann prüfen, wo es steht</translation>
    </message>
    <message>
        <source>the device reports a fault ({fault}); clear it first</source>
        <translation>das Gerät meldet einen Fehler ({fault}); erst quittieren</translation>
    </message>
    <message>
        <source>the device does not answer; wait until it does</source>
        <translation>das Gerät antwortet nicht; warten, bis es antwortet</translation>
    </message>
    <message>
        <source>the device&apos;s parameters are not those of the robot file ({difference}); write or accept them first</source>
        <translation>die Parameter des Geräts sind nicht die der Roboterdatei ({difference}); erst schreiben oder übernehmen</translation>
    </message>
    <message>
        <source>the position of {axes} is not known; home first</source>
        <translation>die Position von {axes} ist unbekannt; erst Referenzfahrt</translation>
    </message>
    <message>
        <source>the position is not known yet</source>
        <translation>die Position ist noch nicht bekannt</translation>
    </message>
    <message>
        <source>{reason}: the position may be wrong; home, or confirm it</source>
        <translation>{reason}: die Position kann falsch sein; Referenzfahrt oder bestätigen</translation>
    </message>
    <message>
        <source>the device has sent nothing for {seconds} s; wait, or reconnect</source>
        <translation>das Gerät hat seit {seconds} s nichts gesendet; warten oder wieder verbinden</translation>
    </message>
    <message>
        <source>{stop} is latched; release it first</source>
        <translation>{stop} ist eingerastet; erst freigeben</translation>
    </message>
    <message>
        <source>this is a replay; nothing moves</source>
        <translation>dies ist eine Wiedergabe; nichts bewegt sich</translation>
    </message>
    <message>
        <source>motion is locked: {reason}</source>
        <translation>Bewegung ist gesperrt: {reason}</translation>
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
        <source>emergency stop</source>
        <translation>Not-Halt</translation>
    </message>
    <message>
        <source>the joystick&apos;s emergency stop</source>
        <translation>Not-Halt des Joysticks</translation>
    </message>
    <message>
        <source>the connection was lost</source>
        <translation>die Verbindung ging verloren</translation>
    </message>
    <message>
        <source>the joystick&apos;s stop</source>
        <translation>das Stopp des Joysticks</translation>
    </message>
    <message>
        <source>the window does not answer</source>
        <translation>das Fenster antwortet nicht</translation>
    </message>
    <message>
        <source>the device is let go of</source>
        <translation>das Gerät wird losgelassen</translation>
    </message>
    <message>
        <source>another device is connected</source>
        <translation>ein anderes Gerät wird verbunden</translation>
    </message>
    <message>
        <source>the input devices are let go of</source>
        <translation>die Eingabegeräte werden losgelassen</translation>
    </message>
    <message>
        <source>the playback is paused</source>
        <translation>das Abspielen ist angehalten</translation>
    </message>
    <message>
        <source>the playback is ended</source>
        <translation>das Abspielen ist beendet</translation>
    </message>
    <message>
        <source>the calibration is given up</source>
        <translation>die Kalibrierung wird aufgegeben</translation>
    </message>
    <message>
        <source>it was stopped</source>
        <translation>es wurde angehalten</translation>
    </message>
    <message>
        <source>Panel</source>
        <translation>Panel</translation>
    </message>
    <message>
        <source>its panel does not allow it now</source>
        <translation>sein Panel lässt es jetzt nicht zu</translation>
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
        <source>{address} is not carried by the program; it is in the folder docs of its source, and on the site that `make docs` makes.</source>
        <translation>{address} ist nicht im Programm enthalten; zu finden im Ordner docs der Quellen und auf den Seiten, die `make docs` macht.</translation>
    </message>
    <message>
        <source># No such page

The program carries no page {name!r}. [All pages]</source>
        <translation># Keine solche Seite

Das Programm enthält keine Seite {name!r}. [Alle Seiten]</translation>
    </message>
    <message>
        <source>Help: {text}</source>
        <translation>Hilfe: {text}</translation>
    </message>
    <message>
        <source>there is no page before this one</source>
        <translation>es gibt keine Seite vor dieser</translation>
    </message>
    <message>
        <source>The page before (Alt+Left)</source>
        <translation>Die Seite davor (Alt+Links)</translation>
    </message>
    <message>
        <source>Stop all axes and hold; a stop by software</source>
        <translation>Alle Achsen anhalten und halten; ein Halt durch Software</translation>
    </message>
    <message>
        <source>Emergency stop: latched until it is released; a stop by software</source>
        <translation>Not-Halt: eingerastet, bis er freigegeben wird; ein Halt durch Software</translation>
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
        <source>None is saved yet</source>
        <translation>Noch keine gespeichert</translation>
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
        <source>Drive the machine: control, devices, trajectory, penetration, recorder</source>
        <translation>Die Maschine fahren: Steuerung, Geräte, Trajektorie, Penetration, Rekorder</translation>
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
        <source>Find out why the machine departs from its model: gap, comparison, effects</source>
        <translation>Herausfinden, warum die Maschine vom Modell abweicht: Lücke, Vergleich, Effekte</translation>
    </message>
    <message>
        <source>write a name</source>
        <translation>einen Namen schreiben</translation>
    </message>
    <message>
        <source>the name has {n} letters; {most} are the most</source>
        <translation>der Name hat {n} Zeichen; höchstens {most} sind möglich</translation>
    </message>
    <message>
        <source>{name} is a layout of the program; choose another name</source>
        <translation>{name} ist eine Anordnung des Programms; einen anderen Namen wählen</translation>
    </message>
    <message>
        <source>{n} layouts are kept, which is the most; delete one first</source>
        <translation>{n} Anordnungen sind gespeichert, mehr geht nicht; erst eine löschen</translation>
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
        <source>How long the window took to react since it was started. When it does not react for a quarter of a second, the log says what it did.</source>
        <translation>Wie lange das Fenster seit dem Start zum Reagieren brauchte. Reagiert es eine Viertelsekunde nicht, sagt das Protokoll, was es tat.</translation>
    </message>
    <message>
        <source>Log</source>
        <translation>Protokoll</translation>
    </message>
    <message>
        <source>Which messages</source>
        <translation>Welche Meldungen</translation>
    </message>
    <message>
        <source>words to look for</source>
        <translation>gesuchte Wörter</translation>
    </message>
    <message>
        <source>Words to look for in messages</source>
        <translation>In Meldungen gesuchte Wörter</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>Kopieren</translation>
    </message>
    <message>
        <source>Help on the chosen message</source>
        <translation>Hilfe zur gewählten Meldung</translation>
    </message>
    <message>
        <source>{n} of {all} messages</source>
        <translation>{n} von {all} Meldungen</translation>
    </message>
    <message>
        <source>Copy the selected messages, or all that are shown</source>
        <translation>Die gewählten Meldungen kopieren oder alle gezeigten</translation>
    </message>
    <message>
        <source>no message is shown</source>
        <translation>keine Meldung wird gezeigt</translation>
    </message>
    <message>
        <source>Window late by {usual} ms at most in 99 %, worst {worst} ms</source>
        <translation>Fenster zu 99 % höchstens {usual} ms verspätet, schlimmstens {worst} ms</translation>
    </message>
    <message>
        <source>no page is about it</source>
        <translation>keine Seite handelt davon</translation>
    </message>
    <message>
        <source>choose one message</source>
        <translation>eine Meldung wählen</translation>
    </message>
    <message>
        <source>What the message means: {page}</source>
        <translation>Was die Meldung bedeutet: {page}</translation>
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
        <source>Load trajectory</source>
        <translation>Trajektorie laden</translation>
    </message>
    <message>
        <source>Open record</source>
        <translation>Aufzeichnung öffnen</translation>
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
        <source>Layout</source>
        <translation>Anordnung</translation>
    </message>
    <message>
        <source>The window closes as soon as everything is written. Close it once more to leave at once: a recording can be recovered at the next start.</source>
        <translation>Das Fenster schließt, sobald alles geschrieben ist. Nochmals schließen beendet sofort: Eine Aufnahme ist beim nächsten Start wiederherstellbar.</translation>
    </message>
    <message>
        <source>Quit</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>The last played record is not kept in any file yet. Quit and lose it?</source>
        <translation>Die letzte abgespielte Aufzeichnung steht noch in keiner Datei. Beenden und verlieren?</translation>
    </message>
    <message>
        <source>This is a stop by software, not the machine&apos;s emergency switch.</source>
        <translation>Dies ist ein Halt durch Software, nicht der Not-Aus-Schalter der Maschine.</translation>
    </message>
    <message>
        <source>E-STOP</source>
        <translation>NOT-HALT</translation>
    </message>
    <message>
        <source>Emergency stop</source>
        <translation>Not-Halt</translation>
    </message>
    <message>
        <source>Latched – release</source>
        <translation>Eingerastet – freigeben</translation>
    </message>
    <message>
        <source>Stop all axes, and let nothing move until it is released (Shift+Esc).</source>
        <translation>Alle Achsen anhalten; nichts bewegt sich bis zur Freigabe (Umschalt+Esc).</translation>
    </message>
    <message>
        <source>Latched: {latched}.</source>
        <translation>Eingerastet: {latched}.</translation>
    </message>
    <message>
        <source>Press to release; nothing moves until it is told to.</source>
        <translation>Drücken gibt frei; ohne Befehl bewegt sich nichts.</translation>
    </message>
    <message>
        <source>Motion</source>
        <translation>Bewegung</translation>
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
        <source>STOP</source>
        <translation>HALT</translation>
    </message>
    <message>
        <source>Stop all axes and hold (Esc).</source>
        <translation>Alle Achsen anhalten und halten (Esc).</translation>
    </message>
    <message>
        <source>Close this notice</source>
        <translation>Diese Meldung schließen</translation>
    </message>
    <message>
        <source>What this means, and what to do: {page}</source>
        <translation>Was das bedeutet und was zu tun ist: {page}</translation>
    </message>
    <message>
        <source>Help on this notice</source>
        <translation>Hilfe zu dieser Meldung</translation>
    </message>
    <message>
        <source>Find a command</source>
        <translation>Befehl suchen</translation>
    </message>
    <message>
        <source>a few letters of what to do</source>
        <translation>ein paar Buchstaben des Befehls</translation>
    </message>
    <message>
        <source>Letters of what to do</source>
        <translation>Buchstaben des Befehls</translation>
    </message>
    <message>
        <source>What can be done</source>
        <translation>Was möglich ist</translation>
    </message>
    <message>
        <source>Nothing has these letters.</source>
        <translation>Nichts hat diese Buchstaben.</translation>
    </message>
    <message>
        <source>Not now: {reason}.</source>
        <translation>Nicht jetzt: {reason}.</translation>
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
        <source>disconnected</source>
        <translation>getrennt</translation>
    </message>
    <message>
        <source>connecting</source>
        <translation>verbindet</translation>
    </message>
    <message>
        <source>ready</source>
        <translation>bereit</translation>
    </message>
    <message>
        <source>moving</source>
        <translation>in Bewegung</translation>
    </message>
    <message>
        <source>stopping</source>
        <translation>hält an</translation>
    </message>
    <message>
        <source>short loss</source>
        <translation>kurzer Ausfall</translation>
    </message>
    <message>
        <source>fault</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>position unknown</source>
        <translation>Position unbekannt</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>ausgefallen</translation>
    </message>
    <message>
        <source>locked</source>
        <translation>gesperrt</translation>
    </message>
    <message>
        <source>playing {share:.0f} %</source>
        <translation>spielt ab: {share:.0f} %</translation>
    </message>
    <message>
        <source>looks for its limit switches</source>
        <translation>sucht die Endschalter</translation>
    </message>
    <message>
        <source>Stopped by the operator at {time}</source>
        <translation>Vom Bediener um {time} gestoppt</translation>
    </message>
    <message>
        <source>Stopped by the program at {time}</source>
        <translation>Vom Programm um {time} gestoppt</translation>
    </message>
    <message>
        <source>Phase of the session</source>
        <translation>Phase der Sitzung</translation>
    </message>
    <message>
        <source>time [s]</source>
        <translation>Zeit [s]</translation>
    </message>
    <message>
        <source>{doing} Called off; nothing was changed.</source>
        <translation>{doing} Abgebrochen; nichts wurde geändert.</translation>
    </message>
    <message>
        <source>{doing} Is being called off.</source>
        <translation>{doing} Wird abgebrochen.</translation>
    </message>
    <message>
        <source>{doing} About {left} left.</source>
        <translation>{doing} Noch etwa {left}.</translation>
    </message>
    <message>
        <source>{doing} For {passed} now.</source>
        <translation>{doing} Seit {passed}.</translation>
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
        <source>Call this work off</source>
        <translation>Diese Arbeit abbrechen</translation>
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
        <source>● Recording {time}  {size}</source>
        <translation>● Aufnahme {time}  {size}</translation>
    </message>
    <message>
        <source>Phase in the recording</source>
        <translation>Phase in der Aufnahme</translation>
    </message>
    <message>
        <source>How the machine stood then; how it stands now is in the tool bar</source>
        <translation>Wie die Maschine damals stand; wie sie jetzt steht, zeigt die Leiste</translation>
    </message>
    <message>
        <source>The machine moves now</source>
        <translation>Die Maschine bewegt sich</translation>
    </message>
    <message>
        <source>Back to live</source>
        <translation>Zurück zu live</translation>
    </message>
    <message>
        <source>Show the machine again, and let it be moved</source>
        <translation>Wieder die Maschine zeigen und bewegen lassen</translation>
    </message>
    <message>
        <source>Go on with the replay, or hold it</source>
        <translation>Wiedergabe fortsetzen oder anhalten</translation>
    </message>
    <message>
        <source>Time of the recording. Marks: faults, then stops, refusals and warnings, then the rest</source>
        <translation>Zeit der Aufnahme. Marken: Fehler, dann Halte, Ablehnungen und Warnungen, dann der Rest</translation>
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
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>Speed of the replay</source>
        <translation>Tempo der Wiedergabe</translation>
    </message>
    <message>
        <source>How many times as fast as it happened</source>
        <translation>Wievielmal so schnell wie geschehen</translation>
    </message>
    <message>
        <source>a replay of {name} is shown; go back to live first</source>
        <translation>eine Wiedergabe von {name} wird gezeigt; erst zurück zu live</translation>
    </message>
    <message>
        <source>{name} cannot be shown: a penetration is {phase}; end it first</source>
        <translation>{name} kann nicht gezeigt werden: eine Penetration läuft ({phase}); erst beenden</translation>
    </message>
    <message>
        <source>{name} cannot be shown: the machine moves; wait, or stop it first</source>
        <translation>{name} kann nicht gezeigt werden: die Maschine bewegt sich; warten oder erst anhalten</translation>
    </message>
    <message>
        <source>{name}: recorded on robot {robot!r} with axes {axes}; this window&apos;s has {here}. Start a window for it: rotemina recording info --robot-file {path} &gt; {file} &amp;&amp; rotemina --robot {file}</source>
        <translation>{name}: aufgenommen am Roboter {robot!r} mit den Achsen {axes}; der dieses Fensters hat {here}. Ein Fenster dafür starten: rotemina recording info --robot-file {path} &gt; {file} &amp;&amp; rotemina --robot {file}</translation>
    </message>
    <message>
        <source>{name}: recorded with another robot file; ranges and scales on the screen are those of this window&apos;s</source>
        <translation>{name}: mit einer anderen Roboterdatei aufgenommen; Bereiche und Skalen sind die dieses Fensters</translation>
    </message>
    <message>
        <source>driver {name!r} cannot be made: {kind}: {error}</source>
        <translation>Treiber {name!r} lässt sich nicht anlegen: {kind}: {error}</translation>
    </message>
    <message>
        <source>{latched} latched</source>
        <translation>{latched} eingerastet</translation>
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
        <source>What the program told since it was started</source>
        <translation>Was das Programm seit dem Start gemeldet hat</translation>
    </message>
    <message>
        <source>Preferences of the screen, and settings of drivers</source>
        <translation>Vorlieben der Anzeige und Einstellungen der Treiber</translation>
    </message>
    <message>
        <source>Versions of the program, its libraries and plugins</source>
        <translation>Versionen des Programms, seiner Bibliotheken und Plugins</translation>
    </message>
    <message>
        <source>Robot, driver, and how the connection stands</source>
        <translation>Roboter, Treiber und Stand der Verbindung</translation>
    </message>
    <message>
        <source>How late the window reacted; the log says to what</source>
        <translation>Wie spät das Fenster reagierte; das Protokoll sagt, worauf</translation>
    </message>
    <message>
        <source>The last record: commands and readings</source>
        <translation>Die letzte Aufzeichnung: Sollwerte und Messwerte</translation>
    </message>
    <message>
        <source>This is what the bundle will hold. User names, home folders and the name of this computer are taken out already. Nothing is sent: the archive is written where you choose.</source>
        <translation>Das wird das Paket enthalten. Benutzernamen, Heimatordner und der Name dieses Rechners sind schon entfernt. Nichts wird gesendet: Das Archiv entsteht am gewählten Ort.</translation>
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
        <source>The support bundle is written.</source>
        <translation>Das Support-Paket wird geschrieben.</translation>
    </message>
    <message>
        <source>Saved {path}</source>
        <translation>Gespeichert: {path}</translation>
    </message>
    <message>
        <source>The support bundle is put together.</source>
        <translation>Das Support-Paket wird zusammengestellt.</translation>
    </message>
    <message>
        <source>the bundle is still being put together</source>
        <translation>das Paket wird noch zusammengestellt</translation>
    </message>
    <message>
        <source>Write all of it into one zip archive</source>
        <translation>Alles in ein Zip-Archiv schreiben</translation>
    </message>
    <message>
        <source>Time of the replay</source>
        <translation>Zeit der Wiedergabe</translation>
    </message>
    <message>
        <source>Carrying the past on …</source>
        <translation>Die Vorgeschichte wird übernommen …</translation>
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
        <source>The recording is put into one file.</source>
        <translation>Die Aufnahme wird in eine Datei gebracht.</translation>
    </message>
    <message>
        <source>Playback paused: {text}. Look at the machine; then go on, or end it.</source>
        <translation>Wiedergabe pausiert: {text}. Die Maschine ansehen; dann fortsetzen oder beenden.</translation>
    </message>
    <message>
        <source>{parent}: cannot be made: {strerror}</source>
        <translation>{parent}: lässt sich nicht anlegen: {strerror}</translation>
    </message>
    <message>
        <source>Keeping {name} …</source>
        <translation>{name} wird aufbewahrt …</translation>
    </message>
    <message>
        <source>The nominal model is in use again: {why}.</source>
        <translation>Das Nominalmodell ist wieder im Einsatz: {why}.</translation>
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
        <source>Comparing model and real …</source>
        <translation>Modell und Maschine werden verglichen …</translation>
    </message>
    <message>
        <source>As the system speaks</source>
        <translation>Wie das System</translation>
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
        <source>RoTeMiNa has a fault: {error}. The log has more; save a support bundle.</source>
        <translation>RoTeMiNa hat einen Fehler: {error}. Mehr steht im Protokoll; speichern Sie ein Support-Paket.</translation>
    </message>
    <message>
        <source>Panel {name!r} is left out: it fails to paint itself: {error}</source>
        <translation>Das Panel {name!r} fehlt: Es kann sich nicht zeichnen: {error}</translation>
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
        <source>The preferences begin anew: {fault}. That file is kept as {path}.</source>
        <translation>Die Einstellungen beginnen neu: {fault}. Diese Datei ist als {path} aufgehoben.</translation>
    </message>
    <message>
        <source>The preferences begin anew, and none is kept: {fault}. Move that file away.</source>
        <translation>Die Einstellungen beginnen neu, und keine wird behalten: {fault}. Verschieben Sie diese Datei.</translation>
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
        <source>nothing moved</source>
        <translation>nichts hat sich bewegt</translation>
    </message>
    <message>
        <source>without offset {without} · nominal {nominal}</source>
        <translation>ohne Versatz {without} · nominal {nominal}</translation>
    </message>
    <message>
        <source>Model in use</source>
        <translation>Modell im Einsatz</translation>
    </message>
    <message>
        <source>Back to nominal</source>
        <translation>Zurück zum Nominalmodell</translation>
    </message>
    <message>
        <source>The model that plots, comparison, dry run and 3-D view use.</source>
        <translation>Das Modell, das Kurven, Vergleich, Probelauf und 3-D-Ansicht verwenden.</translation>
    </message>
    <message>
        <source>Predictions only: what is sent to the machine does not change; Compensate does that.</source>
        <translation>Nur Vorhersagen: Was an die Maschine geht, ändert sich nicht; das tut „Kompensieren“.</translation>
    </message>
    <message>
        <source>≈ What {axes} did before is not known: until it has swung through its range, the model may be off by the band in the plots.</source>
        <translation>≈ Was {axes} zuvor getan hat, ist nicht bekannt: Bis der ganze Bereich einmal durchfahren ist, kann das Modell um das Band in den Kurven danebenliegen.</translation>
    </message>
    <message>
        <source>Nominal model</source>
        <translation>Nominalmodell</translation>
    </message>
    <message>
        <source>Corrected: {effects}</source>
        <translation>Korrigiert: {effects}</translation>
    </message>
</context>
</TS>
