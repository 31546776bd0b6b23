<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>panels</name>
    <message>
        <source>Penetration</source>
        <translation>Penetration</translation>
    </message>
</context>
<context>
    <name>penetration</name>
    <message>
        <source>Cells for demonstrations belong to the simulator. On a real machine put a real one under the tip.</source>
        <translation>Demonstrationszellen gibt es nur im Simulator. An der Maschine eine echte unter die Spitze legen.</translation>
    </message>
    <message>
        <source>An elastic membrane, the effect “contact”; the other effects stay. It does not break: take it away during the thrust to let it give way.</source>
        <translation>Eine elastische Membran, der Effekt „contact“; die anderen Effekte bleiben. Sie bricht nicht: während des Einstichs wegnehmen, damit sie nachgibt.</translation>
    </message>
    <message>
        <source>From where the axis stands, above 0 µm</source>
        <translation>Vom Ort der Achse aus, über 0 µm</translation>
    </message>
    <message>
        <source>Way to the cell, µm</source>
        <translation>Weg zur Zelle, µm</translation>
    </message>
    <message>
        <source>Stiffness of the cell</source>
        <translation>Steifigkeit der Zelle</translation>
    </message>
    <message>
        <source>Over that of the axis itself, up to 30</source>
        <translation>Bezogen auf die der Achse, bis 30</translation>
    </message>
    <message>
        <source>Put a cell there</source>
        <translation>Zelle setzen</translation>
    </message>
    <message>
        <source>Take it away</source>
        <translation>Wegnehmen</translation>
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
        <source>× the axis&apos;</source>
        <translation>× Achse</translation>
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
        <source>Put a cell ahead of where the axis is now, or move it there</source>
        <translation>Eine Zelle vor den jetzigen Ort der Achse setzen oder dorthin verschieben</translation>
    </message>
    <message>
        <source>there is none</source>
        <translation>es gibt keine</translation>
    </message>
    <message>
        <source>way to the cell</source>
        <translation>Weg zur Zelle</translation>
    </message>
    <message>
        <source>stiffness</source>
        <translation>Steifigkeit</translation>
    </message>
    <message>
        <source>{name}: {text!r}; type a number above 0, with a decimal point</source>
        <translation>{name}: {text!r}; eine Zahl über 0 eingeben, mit Dezimalkomma</translation>
    </message>
    <message>
        <source>a cell at {at} of {axis}: must be {least} to {most}; move the axis away from its end first</source>
        <extracomment>Where a cell is put and how stiff it is beside the axis itself, unless told otherwise.</extracomment>
        <translation>eine Zelle bei {at} von {axis}: erlaubt {least} bis {most}; die Achse zuerst vom Ende wegfahren</translation>
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
        <source>The thrust as points, a line each: time share, depth share.</source>
        <translation>Der Einstich als Punkte, je Zeile: Zeitanteil, Tiefenanteil.</translation>
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
        <source>Write these parameters into a TOML file</source>
        <translation>Diese Parameter in eine TOML-Datei schreiben</translation>
    </message>
    <message>
        <source>Take parameters from a TOML file in place of these</source>
        <translation>Parameter aus einer TOML-Datei statt dieser laden</translation>
    </message>
    <message>
        <source>Axis of the penetration</source>
        <translation>Achse der Penetration</translation>
    </message>
    <message>
        <source>The axis that goes into the cell</source>
        <translation>Die Achse, die in die Zelle fährt</translation>
    </message>
    <message>
        <source>Direction</source>
        <translation>Richtung</translation>
    </message>
    <message>
        <source>Where the cell is along the axis; down: towards smaller positions</source>
        <translation>Wo die Zelle entlang der Achse liegt; abwärts: zu kleineren Positionen</translation>
    </message>
    <message>
        <source>Shape of the thrust</source>
        <translation>Form des Einstichs</translation>
    </message>
    <message>
        <source>Its profile of speed</source>
        <translation>Sein Geschwindigkeitsprofil</translation>
    </message>
    <message>
        <source>Input shaping</source>
        <translation>Impulsformung</translation>
    </message>
    <message>
        <source>Against the axis&apos; resonance, as of the robot file. ZV, ZVD, ZVDD: impulses, each slower and surer; inverse model: follows best</source>
        <translation>Gegen die Resonanz der Achse laut Roboterdatei. ZV, ZVD, ZVDD: Impulse, je langsamer und sicherer; inverses Modell: folgt am besten</translation>
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
        <source>More of the contact detection</source>
        <translation>Mehr zur Kontakterkennung</translation>
    </message>
    <message>
        <source>How the contact is told from noise, hysteresis and creep</source>
        <translation>Wie der Kontakt von Rauschen, Hysterese und Kriechen unterschieden wird</translation>
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
        <source>Runs, the latest first</source>
        <translation>Läufe, der neueste zuerst</translation>
    </message>
    <message>
        <source>All of the chosen run</source>
        <translation>Alles zum gewählten Lauf</translation>
    </message>
    <message>
        <source>All that was logged of the chosen run</source>
        <translation>Alles, was zum gewählten Lauf protokolliert wurde</translation>
    </message>
    <message>
        <source>Choose a run to see all of it.</source>
        <translation>Einen Lauf wählen, um alles zu sehen.</translation>
    </message>
    <message>
        <source>{count} shown, {ours} of this start. Log file: {path}</source>
        <translation>{count} gezeigt, {ours} seit dem Start. Protokolldatei: {path}</translation>
    </message>
    <message>
        <source>Penetrations (*.toml);;All files (*)</source>
        <translation>Penetrationen (*.toml);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>What the penetration does</source>
        <translation>Was die Penetration tut</translation>
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
        <source>{name} is not taken: a penetration is armed or runs.</source>
        <translation>{name} wird nicht übernommen: eine Penetration ist scharf oder läuft.</translation>
    </message>
    <message>
        <source>Reading {name} …</source>
        <translation>{name} wird gelesen …</translation>
    </message>
    <message>
        <source>Nothing is saved: {reason}</source>
        <translation>Nichts gespeichert: {reason}</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>wartet</translation>
    </message>
    <message>
        <source>skipped</source>
        <translation>ausgelassen</translation>
    </message>
    <message>
        <source>done</source>
        <translation>fertig</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>misslungen</translation>
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
        <translation>Auslassen</translation>
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
        <source>a penetration is armed or runs</source>
        <translation>eine Penetration ist scharf oder läuft</translation>
    </message>
    <message>
        <source>it moves</source>
        <translation>sie bewegt sich</translation>
    </message>
    <message>
        <source>the list is empty</source>
        <translation>die Liste ist leer</translation>
    </message>
    <message>
        <source>go to a cell</source>
        <translation>erst zu einer Zelle fahren</translation>
    </message>
    <message>
        <source>no other cell waits</source>
        <translation>keine andere Zelle wartet</translation>
    </message>
    <message>
        <source>its place is not known</source>
        <translation>ihr Ort ist nicht bekannt</translation>
    </message>
    <message>
        <source>Add a cell where the machine is now, the tip above it</source>
        <translation>Eine Zelle dort hinzufügen, wo die Maschine jetzt steht, die Spitze darüber</translation>
    </message>
    <message>
        <source>Go to the next cell that waits: up, across, down</source>
        <translation>Zur nächsten wartenden Zelle fahren: auf, hinüber, ab</translation>
    </message>
    <message>
        <source>Leave this cell out</source>
        <translation>Diese Zelle auslassen</translation>
    </message>
    <message>
        <source>Arm for this cell; Start, above, then moves</source>
        <translation>Für diese Zelle scharf machen; erst Start, oben, bewegt</translation>
    </message>
    <message>
        <source>Remove the marked cell</source>
        <translation>Die markierte Zelle entfernen</translation>
    </message>
    <message>
        <source>Write the list as CSV</source>
        <translation>Die Liste als CSV schreiben</translation>
    </message>
    <message>
        <source>Writing {name} …</source>
        <translation>{name} wird geschrieben …</translation>
    </message>
    <message>
        <source>Saved {path}</source>
        <translation>{path} gespeichert</translation>
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
        <source>it is armed or runs; disarm it first</source>
        <translation>scharf oder im Lauf; zuerst sichern</translation>
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
        <source>{n} lines of the log are none: {first}</source>
        <translation>{n} Zeilen des Protokolls sind unlesbar: {first}</translation>
    </message>
    <message>
        <source>Reading the log …</source>
        <translation>Protokoll wird gelesen …</translation>
    </message>
    <message>
        <source>wanted</source>
        <translation>Wunsch</translation>
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
        <source>Wanted: the planned motion of the tip. Commanded: the output of the device. Measured: the latest run, its constant delay removed.</source>
        <translation>Gewünscht: die geplante Bewegung der Spitze. Befohlen: die Ausgabe des Geräts. Gemessen: der letzte Lauf ohne seine konstante Verzögerung.</translation>
    </message>
    <message>
        <source>What the plot shows</source>
        <translation>Was das Diagramm zeigt</translation>
    </message>
    <message>
        <source>Way into the cell, or speed</source>
        <translation>Weg in die Zelle oder Geschwindigkeit</translation>
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
        <source>{title}: {text!r} is no number; type one{unit}, with a decimal point</source>
        <translation>{title}: {text!r} ist keine Zahl; eine{unit} eingeben, mit Dezimalkomma</translation>
    </message>
    <message>
        <source>{title}: {value} is refused: must be {least} to {most}</source>
        <translation>{title}: {value} wird abgelehnt: erlaubt {least} bis {most}</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Tempo</translation>
    </message>
    <message>
        <source>Speed of the approach</source>
        <translation>Geschwindigkeit der Annäherung</translation>
    </message>
    <message>
        <source>At most</source>
        <translation>Höchstens</translation>
    </message>
    <message>
        <source>Without a contact by then the tip goes back, and the run has failed</source>
        <translation>Ohne Kontakt bis dahin fährt die Spitze zurück, der Lauf ist gescheitert</translation>
    </message>
    <message>
        <source>False alarms</source>
        <translation>Fehlalarme</translation>
    </message>
    <message>
        <source>Of the detector, on noise alone; fewer make it slower</source>
        <translation>Der Erkennung, bei bloßem Rauschen; weniger macht sie langsamer</translation>
    </message>
    <message>
        <source>Drift</source>
        <translation>Drift</translation>
    </message>
    <message>
        <source>Slope of measured − model that hysteresis, creep and gain may cause; less finds softer membranes</source>
        <translation>Steigung von gemessen − Modell, die Hysterese, Kriechen und Verstärkung verursachen dürfen; weniger findet weichere Membranen</translation>
    </message>
    <message>
        <source>Drift over</source>
        <translation>Drift über</translation>
    </message>
    <message>
        <source>Way over which that slope may change by as much</source>
        <translation>Weg, über den sich diese Steigung um ebenso viel ändern darf</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>At rest on the membrane before the thrust</source>
        <translation>In Ruhe auf der Membran vor dem Einstich</translation>
    </message>
    <message>
        <source>Depth</source>
        <translation>Tiefe</translation>
    </message>
    <message>
        <source>Of the thrust, from where the approach came to rest on the membrane</source>
        <translation>Des Einstichs, vom Ruheort der Anfahrt auf der Membran</translation>
    </message>
    <message>
        <source>Duration</source>
        <translation>Dauer</translation>
    </message>
    <message>
        <source>Of the thrust, shaping included</source>
        <translation>Des Einstichs, mit Impulsformung</translation>
    </message>
    <message>
        <source>Ramp</source>
        <translation>Rampe</translation>
    </message>
    <message>
        <source>Of an S-curve: share of the time to speed up, and again to slow down</source>
        <translation>Einer S-Kurve: Zeitanteil zum Beschleunigen und ebenso zum Bremsen</translation>
    </message>
    <message>
        <source>Hold</source>
        <translation>Halten</translation>
    </message>
    <message>
        <source>At depth, before the tool is switched on</source>
        <translation>In der Tiefe, bevor das Werkzeug einschaltet</translation>
    </message>
    <message>
        <source>Inject</source>
        <translation>Injektion</translation>
    </message>
    <message>
        <source>With the tool on; 0: the tool stays off</source>
        <translation>Mit Werkzeug ein; 0: das Werkzeug bleibt aus</translation>
    </message>
    <message>
        <source>Hold after</source>
        <translation>Nachhalten</translation>
    </message>
    <message>
        <source>At depth, after the tool was switched off</source>
        <translation>In der Tiefe, nachdem das Werkzeug ausgeschaltet hat</translation>
    </message>
    <message>
        <source>Speed back</source>
        <translation>Tempo zurück</translation>
    </message>
    <message>
        <source>Speed of the retraction</source>
        <translation>Geschwindigkeit des Rückzugs</translation>
    </message>
    <message>
        <source>Greatest deviation of the axis from its set-point; beyond it, the tip retracts at once</source>
        <translation>Größte Abweichung der Achse vom Sollwert; darüber geht die Spitze sofort zurück</translation>
    </message>
    <message>
        <source>After this time it disarms automatically</source>
        <translation>Nach dieser Zeit entschärft sie sich selbst</translation>
    </message>
    <message>
        <source>Depth off by</source>
        <translation>Tiefenfehler</translation>
    </message>
    <message>
        <source>How far the measured depth may miss the asked one; else the run has failed</source>
        <translation>Wie weit die gemessene Tiefe die gewünschte verfehlen darf; sonst ist der Lauf gescheitert</translation>
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
        <source>Greatest instantaneous speed of the thrust</source>
        <translation>Größte Momentangeschwindigkeit des Einstichs</translation>
    </message>
    <message>
        <source>End depth</source>
        <translation>Endtiefe</translation>
    </message>
    <message>
        <source>Where the thrust is commanded to end, from where the approach came to rest</source>
        <translation>Wo der Einstich laut Sollwert endet, vom Ruheort der Anfahrt</translation>
    </message>
    <message>
        <source>Room needed</source>
        <translation>Raumbedarf</translation>
    </message>
    <message>
        <source>Approach, halt and thrust together</source>
        <translation>Anfahrt, Anhalten und Einstich zusammen</translation>
    </message>
    <message>
        <source>Room left</source>
        <translation>Raum frei</translation>
    </message>
    <message>
        <source>From where the axis stands to the end of its range, in the cell&apos;s direction</source>
        <translation>Vom Ort der Achse bis zum Ende ihres Bereichs, in Richtung der Zelle</translation>
    </message>
    <message>
        <source>Way</source>
        <translation>Weg</translation>
    </message>
    <message>
        <source>How far the axis is commanded from where the run began</source>
        <translation>Wie weit der Sollwert vom Beginn des Laufs entfernt ist</translation>
    </message>
    <message>
        <source>Deviation</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>Change of measured − model since the run began, against the motion</source>
        <translation>Änderung von gemessen − Modell seit Beginn des Laufs, gegen die Bewegung</translation>
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
        <source>Beyond {most:.4g} µm the run has failed, and the tip goes back.</source>
        <translation>Über {most:.4g} µm ist der Lauf gescheitert, und die Spitze fährt zurück.</translation>
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
        <source>{driver} has no tool that could be switched</source>
        <translation>{driver} hat kein schaltbares Werkzeug</translation>
    </message>
    <message>
        <source>the penetration switches it by itself while it runs</source>
        <translation>im Lauf schaltet es die Penetration selbst</translation>
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
        <source>it is in {phase}; stop it first</source>
        <translation>in Phase {phase}; zuerst anhalten</translation>
    </message>
    <message>
        <source>Move Z nano back as far as the penetration needs; Z makes up for it, and the tip stays</source>
        <translation>Z nano so weit zurückfahren, wie die Penetration braucht; Z gleicht es aus, die Spitze bleibt</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Ausgang</translation>
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
        <source>When the run was started</source>
        <translation>Wann der Lauf gestartet wurde</translation>
    </message>
    <message>
        <source>Height of the tip where the contact was told; where the axis was, without a tip</source>
        <translation>Höhe der Spitze bei erkanntem Kontakt; ohne Spitze der Ort der Achse</translation>
    </message>
    <message>
        <source>How far the axis went in the thrust, by its own sensor</source>
        <translation>Wie weit die Achse im Einstich fuhr, laut eigenem Sensor</translation>
    </message>
    <message>
        <source>Average speed of the thrust, measured</source>
        <translation>Mittlere Geschwindigkeit des Einstichs, gemessen</translation>
    </message>
    <message>
        <source>Greatest speed of the thrust, measured over five samples</source>
        <translation>Größte Geschwindigkeit des Einstichs, über fünf Messwerte</translation>
    </message>
    <message>
        <source>Greatest distance from the profile, a constant delay taken off</source>
        <translation>Größter Abstand vom Profil, ohne konstante Totzeit</translation>
    </message>
    <message>
        <source>Why it ended as it did</source>
        <translation>Warum er so endete</translation>
    </message>
    <message>
        <source>robot {robot}, driver {driver}</source>
        <translation>Roboter {robot}, Treiber {driver}</translation>
    </message>
    <message>
        <source>began at</source>
        <translation>begann bei</translation>
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
        <source>contact told after</source>
        <translation>Kontakt erkannt nach</translation>
    </message>
    <message>
        <source>Done, aborted by the button, failed, or held by a stop; the tip is retracted unless held</source>
        <translation>Fertig, durch die Taste abgebrochen, fehlgeschlagen oder durch einen Halt gehalten; die Spitze ist zurückgezogen, außer wenn gehalten</translation>
    </message>
    <message>
        <source>in contact from the start</source>
        <translation>von Anfang an in Kontakt</translation>
    </message>
    <message>
        <source>noise, rms</source>
        <translation>Rauschen, effektiv</translation>
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
        <source>cubics miss the profile by</source>
        <translation>Abweichung der Polynome vom Profil</translation>
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
        <source>delay taken off</source>
        <translation>abgezogene Totzeit</translation>
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
        <source>membrane gave way</source>
        <translation>Membran gab nach</translation>
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
        <source>table: {n} points; must be 2 to {most}, a line each, from 0, 0 to 1, 1</source>
        <extracomment>What a table begins with: slow first, fast in the middle.</extracomment>
        <translation>Tabelle: {n} Punkte; erlaubt 2 bis {most}, je eine Zeile, von 0, 0 bis 1, 1</translation>
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
        <source>table, line {number}: {line!r}; type a time share, a comma and a depth share, such as 0.3, 0.1</source>
        <translation>Tabelle, Zeile {number}: {line!r}; Zeitanteil, Komma und Tiefenanteil eingeben, etwa 0.3, 0.1</translation>
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
        <source>The device runs the thrust by itself.</source>
        <translation>Das Gerät führt den Einstich selbst aus.</translation>
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
        <source>The tip goes back to where it began.</source>
        <translation>Die Spitze fährt an den Anfang zurück.</translation>
    </message>
    <message>
        <source>Bring the tip back to where the run began</source>
        <translation>Die Spitze an den Beginn des Laufs zurückfahren</translation>
    </message>
    <message>
        <source>Stop and retract</source>
        <translation>Halt und Rückzug</translation>
    </message>
    <message>
        <source>Halt, switch the tool off, and bring the tip back along its axis</source>
        <translation>Anhalten, Werkzeug ausschalten und die Spitze entlang ihrer Achse zurückfahren</translation>
    </message>
    <message>
        <source>Begin to approach the cell</source>
        <translation>Die Anfahrt an die Zelle beginnen</translation>
    </message>
    <message>
        <source>Check everything and reserve every axis; nothing moves until Start</source>
        <translation>Alles prüfen und jede Achse reservieren; vor Start bewegt sich nichts</translation>
    </message>
    <message>
        <source>Disarm</source>
        <translation>Sichern</translation>
    </message>
    <message>
        <source>The tip approaches until it touches the membrane.</source>
        <extracomment>The phases of the strip, in their order. Phases in which the parameters are those of a run.</extracomment>
        <translation>Die Spitze nähert sich, bis sie die Membran berührt.</translation>
    </message>
    <message>
        <source>Stop the retraction; the tip stays where it is</source>
        <translation>Den Rückzug anhalten; die Spitze bleibt, wo sie ist</translation>
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
        <source>Leave the tip where it is, and let the axes be moved by hand</source>
        <translation>Die Spitze bleibt, wo sie ist; die Achsen lassen sich von Hand fahren</translation>
    </message>
    <message>
        <source>it is not armed; arm it first</source>
        <translation>nicht scharf; zuerst scharfstellen</translation>
    </message>
    <message>
        <source> Why: {reason}.</source>
        <translation> Grund: {reason}.</translation>
    </message>
    <message>
        <source>Held: {reason}. The tip stays where it is; press Retract to bring it back, or Free the axes to move it by hand.</source>
        <translation>Gehalten: {reason}. Die Spitze bleibt, wo sie ist; „Rückzug“ bringt sie zurück, „Achsen freigeben“ erlaubt Fahren von Hand.</translation>
    </message>
    <message>
        <source>Armed: every axis is reserved. Press Start; nothing moves before.</source>
        <translation>Scharf: jede Achse ist reserviert. Start drücken; vorher bewegt sich nichts.</translation>
    </message>
    <message>
        <source>Ready to be armed.</source>
        <translation>Bereit zum Scharfstellen.</translation>
    </message>
    <message>
        <source>Cannot be armed now: {why_not}</source>
        <translation>Scharfstellen nicht möglich: {why_not}</translation>
    </message>
    <message>
        <source>Disarmed: {reason}</source>
        <translation>Gesichert: {reason}</translation>
    </message>
    <message>
        <source>Done: {depth} deep, {speed} at most, {error} off its profile.</source>
        <translation>Fertig: {depth} tief, höchstens {speed}, {error} neben dem Profil.</translation>
    </message>
    <message>
        <source>{verdict}: {reason} The tip is back.</source>
        <translation>{verdict}: {reason} Die Spitze ist zurück.</translation>
    </message>
</context>
</TS>
