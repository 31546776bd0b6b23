<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>job</name>
    <message>
        <source>Trajectory</source>
        <translation>Trajektorie</translation>
    </message>
    <message>
        <source>Load …</source>
        <translation>Laden …</translation>
    </message>
    <message>
        <source>Choose a trajectory file; a dry run tries it first</source>
        <translation>Eine Trajektoriendatei wählen; ein Probelauf prüft sie zuerst</translation>
    </message>
    <message>
        <source>End</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>Stop, and begin anew next</source>
        <translation>Anhalten; danach beginnt es von vorn</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Halt</translation>
    </message>
    <message>
        <source>All axes stop and hold (Esc)</source>
        <translation>Alle Achsen halten an und bleiben stehen (Esc)</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>Zeigen</translation>
    </message>
    <message>
        <source>Bring its panel to the front</source>
        <translation>Sein Panel nach vorn holen</translation>
    </message>
    <message>
        <source>Penetration</source>
        <translation>Penetration</translation>
    </message>
    <message>
        <source>Motion</source>
        <translation>Bewegung</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Aufzeichnung</translation>
    </message>
    <message>
        <source>End recording</source>
        <translation>Aufzeichnung beenden</translation>
    </message>
    <message>
        <source>Put what was recorded into one file; motion goes on</source>
        <translation>Das Aufgezeichnete in eine Datei bringen; die Bewegung geht weiter</translation>
    </message>
    <message>
        <source>Play, pause, go on (Ctrl+P); the axes first go to the first row</source>
        <translation>Abspielen, anhalten, fortsetzen (Strg+P); die Achsen fahren zuerst zur ersten Zeile</translation>
    </message>
    <message>
        <source>Recorded {path}</source>
        <translation>Aufgezeichnet: {path}</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>Vergleichen</translation>
    </message>
    <message>
        <source>Model and real of this run, axis by axis</source>
        <translation>Modell und Wirklichkeit dieses Laufs, Achse für Achse</translation>
    </message>
    <message>
        <source>Diagnose</source>
        <translation>Diagnose</translation>
    </message>
    <message>
        <source>Which effects explain the gap</source>
        <translation>Welche Effekte die Abweichung erklären</translation>
    </message>
    <message>
        <source>No trajectory is loaded</source>
        <translation>Keine Trajektorie ist geladen</translation>
    </message>
    <message>
        <source>is loaded</source>
        <translation>ist geladen</translation>
    </message>
    <message>
        <source>row {row} of {rows}</source>
        <translation>Zeile {row} von {rows}</translation>
    </message>
    <message>
        <source>paused, {row}</source>
        <translation>Pause, {row}</translation>
    </message>
    <message>
        <source>{time} left</source>
        <translation>noch {time}</translation>
    </message>
    <message>
        <source>not recording: {why}</source>
        <translation>zeichnet nicht auf: {why}</translation>
    </message>
    <message>
        <source>The axes move</source>
        <translation>Die Achsen fahren</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Job</source>
        <translation>Auftrag</translation>
    </message>
</context>
</TS>
