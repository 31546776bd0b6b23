<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>job</name>
    <message>
        <source>nothing has been played or opened yet</source>
        <translation>noch wurde nichts abgespielt oder geöffnet</translation>
    </message>
    <message>
        <source>No run yet</source>
        <translation>Noch kein Lauf</translation>
    </message>
    <message>
        <source>Trajectory</source>
        <translation>Trajektorie</translation>
    </message>
    <message>
        <source>Load …</source>
        <translation>Laden …</translation>
    </message>
    <message>
        <source>End</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Halt</translation>
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
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>End recording</source>
        <translation>Aufnahme beenden</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>Vergleichen</translation>
    </message>
    <message>
        <source>Diagnose</source>
        <translation>Diagnose</translation>
    </message>
    <message>
        <source>No trajectory is loaded</source>
        <translation>Keine Trajektorie ist geladen</translation>
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
        <translation>keine Aufnahme: {why}</translation>
    </message>
    <message>
        <source>loaded</source>
        <translation>geladen</translation>
    </message>
    <message>
        <source>The axes are moving</source>
        <translation>Die Achsen fahren</translation>
    </message>
    <message>
        <source>Choose a trajectory file; a dry run checks it first</source>
        <translation>Eine Trajektoriendatei wählen; ein Probelauf prüft sie zuerst</translation>
    </message>
    <message>
        <source>Stop; the next playback starts from the beginning</source>
        <translation>Anhalten; das nächste Abspielen beginnt von vorn</translation>
    </message>
    <message>
        <source>Stop all axes and hold their positions (Esc)</source>
        <translation>Alle Achsen anhalten und ihre Position halten (Esc)</translation>
    </message>
    <message>
        <source>Save the recording in one file; motion continues</source>
        <translation>Die Aufnahme in einer Datei speichern; die Bewegung läuft weiter</translation>
    </message>
    <message>
        <source>nothing is playing</source>
        <translation>nichts wird abgespielt</translation>
    </message>
    <message>
        <source>The recording has ended already.</source>
        <translation>Die Aufnahme ist schon beendet.</translation>
    </message>
    <message>
        <source>the recording is being saved</source>
        <translation>die Aufnahme wird gespeichert</translation>
    </message>
    <message>
        <source>Saved the recording {path}</source>
        <translation>Aufnahme gespeichert: {path}</translation>
    </message>
    <message>
        <source>Compare model and machine in this run, axis by axis</source>
        <translation>Modell und Maschine in diesem Lauf vergleichen, Achse für Achse</translation>
    </message>
    <message>
        <source>Find the effects that explain the gap</source>
        <translation>Die Effekte finden, die die Abweichung erklären</translation>
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
