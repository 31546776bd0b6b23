<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>panels</name>
    <message>
        <source>Penetration</source>
        <extracomment>The parameters are saved this long after the latest change.</extracomment>
        <translation>Penetration</translation>
    </message>
</context>
<context>
    <name>penetration</name>
    <message>
        <source>Stiffness of the cell</source>
        <translation>Steifigkeit der Zelle</translation>
    </message>
    <message>
        <source>Ahead of the tip</source>
        <translation>Vor der Spitze</translation>
    </message>
    <message>
        <source>Stiffness</source>
        <translation>Steifigkeit</translation>
    </message>
    <message>
        <source>the axis&apos; position is unknown</source>
        <translation>die Position der Achse ist unbekannt</translation>
    </message>
    <message>
        <source>Remove the simulated cell</source>
        <translation>Die simulierte Zelle entfernen</translation>
    </message>
    <message>
        <source>stiffness</source>
        <translation>Steifigkeit</translation>
    </message>
    <message>
        <source>{at} of {axis}</source>
        <translation>{at} von {axis}</translation>
    </message>
    <message>
        <source>A cell at {places}.</source>
        <translation>Eine Zelle bei {places}.</translation>
    </message>
    <message>
        <source> and </source>
        <translation> und </translation>
    </message>
    <message>
        <source>There is no cell.</source>
        <translation>Es gibt keine Zelle.</translation>
    </message>
    <message>
        <source>table</source>
        <translation>Tabelle</translation>
    </message>
    <message>
        <source>S-curve</source>
        <translation>S-Kurve</translation>
    </message>
    <message>
        <source>minimum jerk</source>
        <translation>minimaler Ruck</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>ZV</source>
        <translation>ZV</translation>
    </message>
    <message>
        <source>ZVD</source>
        <translation>ZVD</translation>
    </message>
    <message>
        <source>ZVDD</source>
        <translation>ZVDD</translation>
    </message>
    <message>
        <source>inverse model</source>
        <translation>inverses Modell</translation>
    </message>
    <message>
        <source>From 0, 0 to 1, 1; 2 to 200 points.</source>
        <translation>Von 0, 0 bis 1, 1; 2 bis 200 Punkte.</translation>
    </message>
    <message>
        <source>Load …</source>
        <translation>Laden …</translation>
    </message>
    <message>
        <source>Save …</source>
        <translation>Speichern …</translation>
    </message>
    <message>
        <source>Axis of the penetration</source>
        <translation>Achse der Penetration</translation>
    </message>
    <message>
        <source>Direction</source>
        <translation>Richtung</translation>
    </message>
    <message>
        <source>Shape of the thrust</source>
        <translation>Form des Einstichs</translation>
    </message>
    <message>
        <source>Input shaping</source>
        <translation>Impulsformung</translation>
    </message>
    <message>
        <source>Table of the thrust: time share, depth share</source>
        <translation>Tabelle des Einstichs: Zeitanteil, Tiefenanteil</translation>
    </message>
    <message>
        <source>More ▸</source>
        <translation>Mehr ▸</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>Cell is</source>
        <translation>Zelle liegt</translation>
    </message>
    <message>
        <source>Shape</source>
        <translation>Form</translation>
    </message>
    <message>
        <source>Shaping</source>
        <translation>Formung</translation>
    </message>
    <message>
        <source>Time share, depth share</source>
        <translation>Zeitanteil, Tiefenanteil</translation>
    </message>
    <message>
        <source>Less ▾</source>
        <translation>Weniger ▾</translation>
    </message>
    <message>
        <source>Runs, latest first</source>
        <translation>Läufe, der neueste zuerst</translation>
    </message>
    <message>
        <source>Penetrations (*.toml);;All files (*)</source>
        <translation>Penetrationen (*.toml);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>the thrust is being planned</source>
        <translation>der Stoß wird geplant</translation>
    </message>
    <message>
        <source>Thrust</source>
        <translation>Einstich</translation>
    </message>
    <message>
        <source>Runs</source>
        <translation>Läufe</translation>
    </message>
    <message>
        <source>Simulated cell</source>
        <translation>Simulierte Zelle</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>wartet</translation>
    </message>
    <message>
        <source>skipped</source>
        <translation>übersprungen</translation>
    </message>
    <message>
        <source>done</source>
        <translation>fertig</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>fehlgeschlagen</translation>
    </message>
    <message>
        <source>Tables (*.csv);;All files (*)</source>
        <translation>Tabellen (*.csv);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Cell</source>
        <translation>Zelle</translation>
    </message>
    <message>
        <source>Outcome</source>
        <translation>Ausgang</translation>
    </message>
    <message>
        <source>Why</source>
        <translation>Warum</translation>
    </message>
    <message>
        <source>Cells</source>
        <translation>Zellen</translation>
    </message>
    <message>
        <source>Add here</source>
        <translation>Hier hinzufügen</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Nächste</translation>
    </message>
    <message>
        <source>Skip</source>
        <translation>Überspringen</translation>
    </message>
    <message>
        <source>Penetrate</source>
        <translation>Penetrieren</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Export …</source>
        <translation>Exportieren …</translation>
    </message>
    <message>
        <source>the list is empty</source>
        <translation>die Liste ist leer</translation>
    </message>
    <message>
        <source>Export cells</source>
        <translation>Zellen exportieren</translation>
    </message>
    <message>
        <source>Load parameters</source>
        <translation>Parameter laden</translation>
    </message>
    <message>
        <source>Save parameters</source>
        <translation>Parameter speichern</translation>
    </message>
    <message>
        <source> The simulator has no cell: place one in Simulated cell.</source>
        <translation> Der Simulator hat keine Zelle: unter Simulierte Zelle eine setzen.</translation>
    </message>
    <message>
        <source>The run was not logged: {problem}</source>
        <translation>Der Lauf wurde nicht protokolliert: {problem}</translation>
    </message>
    <message>
        <source>motion is locked: {locked}</source>
        <translation>Bewegung gesperrt: {locked}</translation>
    </message>
    <message>
        <source>The library has no recording of this run.</source>
        <translation>Die Bibliothek hat keine Aufzeichnung dieses Laufs.</translation>
    </message>
    <message>
        <source>Reading the log …</source>
        <translation>Protokoll wird gelesen …</translation>
    </message>
    <message>
        <source>commanded</source>
        <translation>Sollwert</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>time [ms]</source>
        <translation>Zeit [ms]</translation>
    </message>
    <message>
        <source>Thrust over time</source>
        <translation>Einstich über der Zeit</translation>
    </message>
    <message>
        <source>Position [µm]</source>
        <translation>Position [µm]</translation>
    </message>
    <message>
        <source>Speed [µm/s]</source>
        <translation>Geschwindigkeit [µm/s]</translation>
    </message>
    <message>
        <source>Approach</source>
        <translation>Anfahrt</translation>
    </message>
    <message>
        <source>Contact detection</source>
        <translation>Kontakterkennung</translation>
    </message>
    <message>
        <source>Hold and inject</source>
        <translation>Halten und Injizieren</translation>
    </message>
    <message>
        <source>Retract</source>
        <translation>Rückzug</translation>
    </message>
    <message>
        <source>Limits</source>
        <translation>Grenzen</translation>
    </message>
    <message>
        <source>{title}, {unit}</source>
        <translation>{title}, {unit}</translation>
    </message>
    <message>
        <source>{least} to {most}; preset {preset}</source>
        <translation>{least} bis {most}; Vorgabe {preset}</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Tempo</translation>
    </message>
    <message>
        <source>Speed of the approach</source>
        <translation>Geschwindigkeit der Anfahrt</translation>
    </message>
    <message>
        <source>At most</source>
        <translation>Höchstens</translation>
    </message>
    <message>
        <source>False alarms</source>
        <translation>Fehlalarme</translation>
    </message>
    <message>
        <source>Drift</source>
        <translation>Drift</translation>
    </message>
    <message>
        <source>Drift over</source>
        <translation>Drift über</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Depth</source>
        <translation>Tiefe</translation>
    </message>
    <message>
        <source>Duration</source>
        <translation>Dauer</translation>
    </message>
    <message>
        <source>Ramp</source>
        <translation>Rampe</translation>
    </message>
    <message>
        <source>Hold</source>
        <translation>Halten</translation>
    </message>
    <message>
        <source>Inject</source>
        <translation>Injektion</translation>
    </message>
    <message>
        <source>Hold after</source>
        <translation>Nachhalten</translation>
    </message>
    <message>
        <source>Return speed</source>
        <translation>Rückzugtempo</translation>
    </message>
    <message>
        <source>Speed of the retraction</source>
        <translation>Geschwindigkeit des Rückzugs</translation>
    </message>
    <message>
        <source>Depth tolerance</source>
        <translation>Tiefentoleranz</translation>
    </message>
    <message>
        <source>Overload</source>
        <translation>Überlast</translation>
    </message>
    <message>
        <source>Armed for</source>
        <translation>Scharf für</translation>
    </message>
    <message>
        <source>Average speed</source>
        <translation>Mittl. Tempo</translation>
    </message>
    <message>
        <source>Depth over duration</source>
        <translation>Tiefe durch Dauer</translation>
    </message>
    <message>
        <source>Peak speed</source>
        <translation>Spitzentempo</translation>
    </message>
    <message>
        <source>End depth</source>
        <translation>Endtiefe</translation>
    </message>
    <message>
        <source>Approach, halt and thrust together</source>
        <translation>Anfahrt, Anhalten und Einstich zusammen</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Weg</translation>
    </message>
    <message>
        <source>Deviation</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>Load, up to the overload</source>
        <translation>Last, bis zur Überlast</translation>
    </message>
    <message>
        <source>Run</source>
        <translation>Lauf</translation>
    </message>
    <message>
        <source>Plan</source>
        <translation>Plan</translation>
    </message>
    <message>
        <source>load {value} of {most:.4g} µm</source>
        <translation>Last {value} von {most:.4g} µm</translation>
    </message>
    <message>
        <source>Deviation of the axis from its set-point.</source>
        <translation>Abweichung der Achse vom Sollwert.</translation>
    </message>
    <message>
        <source>Tool is on</source>
        <translation>Werkzeug ein</translation>
    </message>
    <message>
        <source>Tool is off</source>
        <translation>Werkzeug aus</translation>
    </message>
    <message>
        <source>No tool</source>
        <translation>Kein Werkzeug</translation>
    </message>
    <message>
        <source>Switch the tool off</source>
        <translation>Werkzeug ausschalten</translation>
    </message>
    <message>
        <source>Switch the tool on</source>
        <translation>Werkzeug einschalten</translation>
    </message>
    <message>
        <source>Arm</source>
        <translation>Scharfstellen</translation>
    </message>
    <message>
        <source>Nothing was done: the penetration entered another phase just before you pressed. Read the button, then press again.</source>
        <translation>Nichts wurde ausgeführt: Die Penetration ist kurz vor dem Drücken in eine andere Phase übergegangen. Lesen Sie die Taste, und drücken Sie dann noch einmal.</translation>
    </message>
    <message>
        <source>Prepare</source>
        <translation>Vorbereiten</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Start</translation>
    </message>
    <message>
        <source>armed, {left_s:.0f} s</source>
        <translation>scharf, {left_s:.0f} s</translation>
    </message>
    <message>
        <source>Phase of the penetration</source>
        <translation>Phase der Penetration</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Contact</source>
        <translation>Kontakt</translation>
    </message>
    <message>
        <source>Average</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source>Peak</source>
        <translation>Spitze</translation>
    </message>
    <message>
        <source>Error</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Reason</source>
        <translation>Grund</translation>
    </message>
    <message>
        <source>Average speed of the thrust, measured</source>
        <translation>Mittlere Geschwindigkeit des Einstichs, gemessen</translation>
    </message>
    <message>
        <source>robot {robot}, driver {driver}</source>
        <translation>Roboter {robot}, Treiber {driver}</translation>
    </message>
    <message>
        <source>contact at</source>
        <translation>Kontakt bei</translation>
    </message>
    <message>
        <source>contact, as measured</source>
        <translation>Kontakt, gemessen</translation>
    </message>
    <message>
        <source>contact, height of the tip</source>
        <translation>Kontakt, Höhe der Spitze</translation>
    </message>
    <message>
        <source>in contact from the start</source>
        <translation>von Anfang an in Kontakt</translation>
    </message>
    <message>
        <source>noise, rms</source>
        <translation>Rauschen, rms</translation>
    </message>
    <message>
        <source>detector&apos;s threshold</source>
        <translation>Schwelle der Erkennung</translation>
    </message>
    <message>
        <source>planned average speed</source>
        <translation>geplante mittlere Geschwindigkeit</translation>
    </message>
    <message>
        <source>planned peak speed</source>
        <translation>geplante Spitzengeschwindigkeit</translation>
    </message>
    <message>
        <source>depth</source>
        <translation>Tiefe</translation>
    </message>
    <message>
        <source>average speed</source>
        <translation>mittlere Geschwindigkeit</translation>
    </message>
    <message>
        <source>peak speed</source>
        <translation>Spitzengeschwindigkeit</translation>
    </message>
    <message>
        <source>error against the profile</source>
        <translation>Fehler gegen das Profil</translation>
    </message>
    <message>
        <source>samples</source>
        <translation>Messwerte</translation>
    </message>
    <message>
        <source>deviation, peak</source>
        <translation>Abweichung, größte</translation>
    </message>
    <message>
        <source>deviation, at the end</source>
        <translation>Abweichung, am Ende</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>ja</translation>
    </message>
    <message>
        <source>no</source>
        <translation>nein</translation>
    </message>
    <message>
        <source>table, point {number}: time {later:g} must be after {at:g}</source>
        <translation>Tabelle, Punkt {number}: Zeit {later:g} muss nach {at:g} liegen</translation>
    </message>
    <message>
        <source>table: must go from 0, 0 to 1, 1</source>
        <translation>Tabelle: muss von 0, 0 bis 1, 1 gehen</translation>
    </message>
    <message>
        <source>time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>table, line {number}: {name} {value:g} must be 0 to 1</source>
        <translation>Tabelle, Zeile {number}: {name} {value:g}, erlaubt 0 bis 1</translation>
    </message>
    <message>
        <source>Contact. The tip rests on the membrane; the thrust follows.</source>
        <translation>Kontakt. Die Spitze ruht auf der Membran; der Einstich folgt.</translation>
    </message>
    <message>
        <source>The tip holds at its depth.</source>
        <translation>Die Spitze hält in der Tiefe.</translation>
    </message>
    <message>
        <source>The tool is on.</source>
        <translation>Das Werkzeug ist ein.</translation>
    </message>
    <message>
        <source>The tool is off; the tip holds at its depth.</source>
        <translation>Das Werkzeug ist aus; die Spitze hält in der Tiefe.</translation>
    </message>
    <message>
        <source>Stop and retract</source>
        <translation>Halt und Rückzug</translation>
    </message>
    <message>
        <source>Disarm</source>
        <translation>Entschärfen</translation>
    </message>
    <message>
        <source>The tip approaches until it touches the membrane.</source>
        <extracomment>The phases shown in the bar, in their order. A second press within this time is ignored. An alarmed operator may press twice, and the second press must neither stop nor start a retraction. Phases in which the parameters belong to a run and cannot be changed.</extracomment>
        <translation>Die Spitze nähert sich, bis sie die Membran berührt.</translation>
    </message>
    <message>
        <source>Release the axes; nothing has moved</source>
        <translation>Die Achsen freigeben; nichts hat sich bewegt</translation>
    </message>
    <message>
        <source>Free the axes</source>
        <translation>Achsen freigeben</translation>
    </message>
    <message>
        <source>Cannot be armed now: {why_not}</source>
        <translation>Scharfstellen nicht möglich: {why_not}</translation>
    </message>
    <message>
        <source>Disarmed: {reason}</source>
        <translation>Entschärft: {reason}</translation>
    </message>
    <message>
        <source>Points of the thrust, one per line: time share, depth share.</source>
        <translation>Punkte des Einstichs, je Zeile einer: Zeitanteil, Tiefenanteil.</translation>
    </message>
    <message>
        <source>Save these parameters to a TOML file</source>
        <translation>Diese Parameter in eine TOML-Datei speichern</translation>
    </message>
    <message>
        <source>Replace these parameters by those of a TOML file</source>
        <translation>Diese Parameter durch die einer TOML-Datei ersetzen</translation>
    </message>
    <message>
        <source>Axis that penetrates the cell</source>
        <translation>Achse, die in die Zelle einsticht</translation>
    </message>
    <message>
        <source>Direction of the cell along the axis; down: towards smaller positions</source>
        <translation>Richtung der Zelle entlang der Achse; abwärts: zu kleineren Positionen</translation>
    </message>
    <message>
        <source>Speed profile of the thrust</source>
        <translation>Geschwindigkeitsprofil des Einstichs</translation>
    </message>
    <message>
        <source>Suppresses the resonance of the axis in the robot file. ZV, ZVD, ZVDD: impulses, increasingly slow and robust; inverse model: best tracking</source>
        <translation>Unterdrückt die Resonanz der Achse laut Roboterdatei. ZV, ZVD, ZVDD: Impulse, zunehmend langsam und robust; inverses Modell: bestes Folgeverhalten</translation>
    </message>
    <message>
        <source>More settings of the contact detection</source>
        <translation>Weitere Einstellungen der Kontakterkennung</translation>
    </message>
    <message>
        <source>Settings that distinguish contact from noise, hysteresis and creep</source>
        <translation>Einstellungen, die Kontakt von Rauschen, Hysterese und Kriechen unterscheiden</translation>
    </message>
    <message>
        <source>desired</source>
        <translation>gewünscht</translation>
    </message>
    <message>
        <source>Quantity of the plot</source>
        <translation>Größe des Diagramms</translation>
    </message>
    <message>
        <source>Distance into the cell, or speed</source>
        <translation>Weg in die Zelle oder Geschwindigkeit</translation>
    </message>
    <message>
        <source>Desired: planned motion of the tip. Commanded: output of the device. Measured: latest run, constant delay removed.</source>
        <translation>Gewünscht: die geplante Bewegung der Spitze. Sollwert: die Ausgabe des Geräts. Gemessen: der letzte Lauf ohne seine konstante Verzögerung.</translation>
    </message>
    <message>
        <source>Move Z nano back as far as needed; Z compensates, so the tip stays in place</source>
        <translation>Z nano so weit wie nötig zurückfahren; Z gleicht aus, die Spitze bleibt am Ort</translation>
    </message>
    <message>
        <source>the penetration is running ({phase}); stop it first</source>
        <translation>die Penetration läuft ({phase}); zuerst anhalten</translation>
    </message>
    <message>
        <source>The device executes the thrust.</source>
        <translation>Das Gerät führt den Einstich aus.</translation>
    </message>
    <message>
        <source>The tip returns to its start.</source>
        <translation>Die Spitze fährt an ihren Anfang zurück.</translation>
    </message>
    <message>
        <source>Stop the retraction; the tip stays in place</source>
        <translation>Den Rückzug anhalten; die Spitze bleibt, wo sie ist</translation>
    </message>
    <message>
        <source>Return the tip to the start of the run</source>
        <translation>Die Spitze an den Beginn des Laufs zurückfahren</translation>
    </message>
    <message>
        <source>Stop, switch the tool off, and retract the tip along its axis</source>
        <translation>Anhalten, Werkzeug ausschalten und die Spitze entlang ihrer Achse zurückfahren</translation>
    </message>
    <message>
        <source>Start the approach to the cell</source>
        <translation>Die Anfahrt an die Zelle beginnen</translation>
    </message>
    <message>
        <source>Check all conditions and reserve all axes; nothing moves before Start</source>
        <translation>Alle Bedingungen prüfen und alle Achsen reservieren; vor Start bewegt sich nichts</translation>
    </message>
    <message>
        <source>Leave the tip in place and release the axes for manual motion</source>
        <translation>Die Spitze an Ort lassen und die Achsen für Handfahrt freigeben</translation>
    </message>
    <message>
        <source>the penetration is not armed; arm it first</source>
        <translation>die Penetration ist nicht scharf; zuerst scharfstellen</translation>
    </message>
    <message>
        <source> Reason: {reason}.</source>
        <translation> Grund: {reason}.</translation>
    </message>
    <message>
        <source>Armed: all axes are reserved. Nothing moves until you press Start.</source>
        <translation>Scharf: alle Achsen sind reserviert. Bis zum Start bewegt sich nichts.</translation>
    </message>
    <message>
        <source>Ready to arm.</source>
        <translation>Bereit zum Scharfstellen.</translation>
    </message>
    <message>
        <source>{verdict}: {reason} The tip is retracted.</source>
        <translation>{verdict}: {reason} Die Spitze ist zurückgezogen.</translation>
    </message>
    <message>
        <source>Held: {reason}. The tip stays in place; press Retract to return it, or Free the axes to move it manually.</source>
        <translation>Gehalten: {reason}. Die Spitze bleibt, wo sie ist; „Rückzug“ bringt sie zurück, „Achsen freigeben“ erlaubt Fahren von Hand.</translation>
    </message>
    <message>
        <source>Done: depth {depth}, maximum speed {speed}, error {error} from the profile.</source>
        <translation>Fertig: Tiefe {depth}, höchstens {speed}, Abweichung {error} vom Profil.</translation>
    </message>
    <message>
        <source>Details of the selected run</source>
        <translation>Einzelheiten des gewählten Laufs</translation>
    </message>
    <message>
        <source>Log of the selected run</source>
        <translation>Protokoll des gewählten Laufs</translation>
    </message>
    <message>
        <source>Select a run to see its details.</source>
        <translation>Einen Lauf wählen, um Einzelheiten zu sehen.</translation>
    </message>
    <message>
        <source>{count} runs, {ours} since the program start. Log file: {path}</source>
        <translation>{count} Läufe, {ours} seit dem Programmstart. Protokolldatei: {path}</translation>
    </message>
    <message>
        <source>select a run</source>
        <translation>Lauf auswählen</translation>
    </message>
    <message>
        <source>a penetration is armed or running</source>
        <translation>eine Penetration ist scharf oder läuft</translation>
    </message>
    <message>
        <source>the machine is moving</source>
        <translation>die Maschine bewegt sich</translation>
    </message>
    <message>
        <source>go to a cell first</source>
        <translation>erst zu einer Zelle fahren</translation>
    </message>
    <message>
        <source>no other cell is waiting</source>
        <translation>keine andere Zelle wartet</translation>
    </message>
    <message>
        <source>Add a cell at the present position, with the tip above it</source>
        <translation>Eine Zelle an der aktuellen Position hinzufügen, die Spitze darüber</translation>
    </message>
    <message>
        <source>Go to the next waiting cell: up, across, down</source>
        <translation>Zur nächsten wartenden Zelle fahren: heben, verfahren, absenken</translation>
    </message>
    <message>
        <source>Skip this cell</source>
        <translation>Diese Zelle überspringen</translation>
    </message>
    <message>
        <source>Arm for this cell; motion begins only with Start, above</source>
        <translation>Für diese Zelle scharfstellen; die Bewegung beginnt erst mit Start, oben</translation>
    </message>
    <message>
        <source>Remove the selected cell</source>
        <translation>Die gewählte Zelle entfernen</translation>
    </message>
    <message>
        <source>Export the list as CSV</source>
        <translation>Die Liste als CSV exportieren</translation>
    </message>
    <message>
        <source>its position is unknown</source>
        <translation>ihre Position ist unbekannt</translation>
    </message>
    <message>
        <source>State of the penetration</source>
        <translation>Zustand der Penetration</translation>
    </message>
    <message>
        <source>the penetration is armed or running; disarm it first</source>
        <translation>die Penetration ist scharf oder läuft; zuerst entschärfen</translation>
    </message>
    <message>
        <source>Not saved: {reason}</source>
        <translation>Nicht gespeichert: {reason}</translation>
    </message>
    <message>
        <source>{name} is not applied: a penetration is armed or running.</source>
        <translation>{name} wird nicht übernommen: eine Penetration ist scharf oder läuft.</translation>
    </message>
    <message>
        <source>{n} lines of the log cannot be read: {first}</source>
        <translation>{n} Zeilen des Protokolls sind unlesbar: {first}</translation>
    </message>
    <message>
        <source>table: {n} points; must be 2 to {most}, one per line, from 0, 0 to 1, 1</source>
        <extracomment>Suggested table: slow at first, fast in the middle.</extracomment>
        <translation>Tabelle: {n} Punkte; erlaubt 2 bis {most}, je eine Zeile, von 0, 0 bis 1, 1</translation>
    </message>
    <message>
        <source>table, line {number}: {line!r}; enter a time share, a comma and a depth share, such as 0.3, 0.1</source>
        <translation>Tabelle, Zeile {number}: {line!r}; Zeitanteil, Komma und Tiefenanteil eingeben, etwa 0.3, 0.1</translation>
    </message>
    <message>
        <source>Start time of the run</source>
        <translation>Startzeit des Laufs</translation>
    </message>
    <message>
        <source>Done, aborted by the button, failed, or held by a stop; the tip retracts unless held</source>
        <translation>Fertig, durch die Taste abgebrochen, fehlgeschlagen oder durch einen Halt gehalten; die Spitze ist zurückgezogen, außer wenn gehalten</translation>
    </message>
    <message>
        <source>Height of the tip at the detected contact; without a tip, position of the axis</source>
        <translation>Höhe der Spitze bei erkanntem Kontakt; ohne Spitze die Position der Achse</translation>
    </message>
    <message>
        <source>Travel of the axis in the thrust, by its own sensor</source>
        <translation>Weg der Achse im Einstich, laut eigenem Sensor</translation>
    </message>
    <message>
        <source>Maximum speed of the thrust, measured over five samples</source>
        <translation>Größte Geschwindigkeit des Einstichs, über fünf Messwerte</translation>
    </message>
    <message>
        <source>Maximum distance from the profile, without a constant delay</source>
        <translation>Größter Abstand vom Profil, ohne konstante Totzeit</translation>
    </message>
    <message>
        <source>Reason for the outcome</source>
        <translation>Grund des Ausgangs</translation>
    </message>
    <message>
        <source>started at</source>
        <translation>begann bei</translation>
    </message>
    <message>
        <source>contact detected after</source>
        <translation>Kontakt erkannt nach</translation>
    </message>
    <message>
        <source>deviation of the cubics from the profile</source>
        <translation>Abweichung der Polynome vom Profil</translation>
    </message>
    <message>
        <source>membrane ruptured</source>
        <translation>Membran gab nach</translation>
    </message>
    <message>
        <source>delay removed</source>
        <translation>abgezogene Totzeit</translation>
    </message>
    <message>
        <source>Travel needed</source>
        <translation>Bedarf</translation>
    </message>
    <message>
        <source>Travel available</source>
        <translation>Verfügbar</translation>
    </message>
    <message>
        <source>Maximum instantaneous speed of the thrust</source>
        <translation>Größte Momentangeschwindigkeit des Einstichs</translation>
    </message>
    <message>
        <source>Commanded end of the thrust, from the position of rest on the membrane</source>
        <translation>Ende des Einstichs laut Sollwert, von der Ruheposition auf der Membran</translation>
    </message>
    <message>
        <source>Travel from the present position to the end of the range, towards the cell</source>
        <translation>Weg von der aktuellen Position bis zum Ende des Bereichs, in Richtung der Zelle</translation>
    </message>
    <message>
        <source>Commanded distance from the start of the run</source>
        <translation>Weg des Sollwerts vom Beginn des Laufs</translation>
    </message>
    <message>
        <source>Change of measured − model since the start of the run, opposite to the motion</source>
        <translation>Änderung von gemessen − Modell seit Beginn des Laufs, gegen die Bewegung</translation>
    </message>
    <message>
        <source>the running penetration controls the tool</source>
        <translation>die laufende Penetration schaltet das Werkzeug</translation>
    </message>
    <message>
        <source>{driver} has no switchable tool</source>
        <translation>{driver} hat kein schaltbares Werkzeug</translation>
    </message>
    <message>
        <source>Above {most:.4g} µm the run fails and the tip retracts.</source>
        <translation>Über {most:.4g} µm scheitert der Lauf, und die Spitze fährt zurück.</translation>
    </message>
    <message>
        <source>Without contact within this distance the run fails and the tip retracts</source>
        <translation>Ohne Kontakt innerhalb dieses Wegs scheitert der Lauf, und die Spitze fährt zurück</translation>
    </message>
    <message>
        <source>Rate of false alarms from noise; fewer alarms make the detection slower</source>
        <translation>Häufigkeit der Fehlalarme durch Rauschen; weniger machen die Erkennung langsamer</translation>
    </message>
    <message>
        <source>Slope of measured − model that hysteresis, creep and gain may cause; a smaller value detects softer membranes</source>
        <translation>Steigung von gemessen − Modell, die Hysterese, Kriechen und Verstärkung verursachen dürfen; ein kleinerer Wert erkennt weichere Membranen</translation>
    </message>
    <message>
        <source>Distance over which that slope may change by the same amount</source>
        <translation>Weg, über den sich diese Steigung um ebenso viel ändern darf</translation>
    </message>
    <message>
        <source>Time at rest on the membrane before the thrust</source>
        <translation>Ruhezeit auf der Membran vor dem Einstich</translation>
    </message>
    <message>
        <source>Depth of the thrust, from the position of rest on the membrane</source>
        <translation>Tiefe des Einstichs, von der Ruheposition auf der Membran</translation>
    </message>
    <message>
        <source>Duration of the thrust, with shaping</source>
        <translation>Dauer des Einstichs, mit Impulsformung</translation>
    </message>
    <message>
        <source>S-curve: share of the time for acceleration, and the same for deceleration</source>
        <translation>S-Kurve: Zeitanteil zum Beschleunigen, ebenso viel zum Bremsen</translation>
    </message>
    <message>
        <source>Time at depth before the tool is switched on</source>
        <translation>Zeit in der Tiefe, bevor das Werkzeug einschaltet</translation>
    </message>
    <message>
        <source>Time with the tool on; 0: the tool stays off</source>
        <translation>Zeit mit Werkzeug ein; 0: das Werkzeug bleibt aus</translation>
    </message>
    <message>
        <source>Time at depth after the tool is switched off</source>
        <translation>Zeit in der Tiefe, nachdem das Werkzeug ausschaltet</translation>
    </message>
    <message>
        <source>Permitted deviation of the measured from the requested depth; above it, the run fails</source>
        <translation>Erlaubte Abweichung der gemessenen von der verlangten Tiefe; darüber scheitert der Lauf</translation>
    </message>
    <message>
        <source>Maximum deviation of the axis from its set-point; above it, the tip retracts at once</source>
        <translation>Größte Abweichung der Achse vom Sollwert; darüber geht die Spitze sofort zurück</translation>
    </message>
    <message>
        <source>Time after which the penetration disarms automatically</source>
        <translation>Zeit, nach der sich die Penetration selbst entschärft</translation>
    </message>
    <message>
        <source>{title}: {text!r} is not a number; enter one{unit} with a decimal point</source>
        <translation>{title}: {text!r} ist keine Zahl; eine{unit} eingeben, mit Dezimalkomma</translation>
    </message>
    <message>
        <source>{title}: {value} must be {least} to {most}</source>
        <translation>{title}: {value}, erlaubt {least} bis {most}</translation>
    </message>
    <message>
        <source>Demonstration cells exist only in the simulator. On a real machine put a real cell under the tip.</source>
        <translation>Demonstrationszellen gibt es nur im Simulator. An einer echten Maschine eine echte Zelle unter die Spitze legen.</translation>
    </message>
    <message>
        <source>Elastic membrane (effect “contact”); other effects stay. The membrane does not break: remove it during the thrust to simulate a rupture.</source>
        <translation>Elastische Membran (Effekt „contact“); andere Effekte bleiben. Sie bricht nicht: während des Einstichs entfernen, um einen Durchbruch zu simulieren.</translation>
    </message>
    <message>
        <source>Distance from the present position of the axis, above 0 µm</source>
        <extracomment>Whether a simulator without a cell is in use.</extracomment>
        <translation>Abstand von der jetzigen Position der Achse, über 0 µm</translation>
    </message>
    <message>
        <source>Distance to the cell, µm</source>
        <translation>Abstand zur Zelle, µm</translation>
    </message>
    <message>
        <source>Relative to the stiffness of the axis, up to 30</source>
        <translation>Relativ zur Steifigkeit der Achse, bis 30</translation>
    </message>
    <message>
        <source>Place a cell ahead of the present position of the axis, or move it there</source>
        <translation>Eine Zelle vor der aktuellen Position der Achse setzen oder dorthin verschieben</translation>
    </message>
    <message>
        <source>Place cell</source>
        <translation>Zelle setzen</translation>
    </message>
    <message>
        <source>× axis</source>
        <translation>× Achse</translation>
    </message>
    <message>
        <source>there is no cell</source>
        <translation>es gibt keine Zelle</translation>
    </message>
    <message>
        <source>a cell at {at} of {axis} must be within {least} to {most}; move the axis away from its end first</source>
        <extracomment>Default distance ahead of the tip, m, and default stiffness relative to the axis.</extracomment>
        <translation>eine Zelle bei {at} von {axis} muss in {least} bis {most} liegen; die Achse zuerst vom Ende wegfahren</translation>
    </message>
    <message>
        <source>distance to the cell</source>
        <translation>Abstand zur Zelle</translation>
    </message>
    <message>
        <source>{name}: {text!r}; enter a number above 0 with a decimal point</source>
        <translation>{name}: {text!r}; eine Zahl über 0 eingeben, mit Dezimalkomma</translation>
    </message>
</context>
</TS>
