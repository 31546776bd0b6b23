<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>panels</name>
    <message>
        <source>Trajectory</source>
        <translation>Trajektorie</translation>
    </message>
</context>
<context>
    <name>trajectory</name>
    <message>
        <source>No trajectory is loaded. Load one to see what it asks of each axis before it is played.</source>
        <translation>Keine Trajektorie geladen. Eine laden, um vor dem Abspielen zu sehen, was sie von jeder Achse verlangt.</translation>
    </message>
    <message>
        <source>The playback pauses when readings are farther from the model than this for 20 ms; double-click to change it, empty it for no bound</source>
        <translation>Die Wiedergabe pausiert, wenn Messwerte 20 ms lang weiter vom Modell entfernt sind; Doppelklick zum Ändern, leer für keine Grenze</translation>
    </message>
    <message>
        <source>Load …</source>
        <translation>Laden …</translation>
    </message>
    <message>
        <source>Take a trajectory from a text file, and try it on the model (Ctrl+T)</source>
        <translation>Trajektorie aus einer Textdatei laden und am Modell erproben (Strg+T)</translation>
    </message>
    <message>
        <source>Resample …</source>
        <translation>Rate …</translation>
    </message>
    <message>
        <source>Another rate, in Hz, for the trajectory in hand</source>
        <translation>Andere Rate, in Hz, für die geladene Trajektorie</translation>
    </message>
    <message>
        <source>{name} – {seconds:.3f} s, {rows} rows</source>
        <translation>{name} – {seconds:.3f} s, {rows} Zeilen</translation>
    </message>
    <message>
        <source>Dry run: inside all limits of range, speed and acceleration. Play first moves the axes to the first row, within the same limits.</source>
        <translation>Probelauf: innerhalb aller Grenzen von Bereich, Geschwindigkeit und Beschleunigung. Abspielen fährt zuerst zur ersten Zeile, in denselben Grenzen.</translation>
    </message>
    <message>
        <source> (and {n} more)</source>
        <translation> (und {n} weitere)</translation>
    </message>
    <message>
        <source>Not playable: {objection}{more}</source>
        <translation>Nicht abspielbar: {objection}{more}</translation>
    </message>
    <message>
        <source>{name}, resampled</source>
        <translation>{name}, neu abgetastet</translation>
    </message>
    <message>
        <source>Model and real apart: {parts}</source>
        <translation>Abstand Modell–Maschine: {parts}</translation>
    </message>
    <message>
        <source>hold – as a device does between rows</source>
        <translation>halten – wie ein Gerät zwischen Zeilen</translation>
    </message>
    <message>
        <source>linear – straight lines between rows</source>
        <translation>linear – Geraden zwischen Zeilen</translation>
    </message>
    <message>
        <source>cubic – smooth, may swing beyond the rows</source>
        <translation>kubisch – glatt, kann über die Zeilen schwingen</translation>
    </message>
    <message>
        <source>Resample the trajectory</source>
        <translation>Trajektorie neu abtasten</translation>
    </message>
    <message>
        <source>Rate in Hz</source>
        <translation>Rate in Hz</translation>
    </message>
    <message>
        <source>Rows per second, Hz; above 0</source>
        <translation>Zeilen je Sekunde, Hz; über 0</translation>
    </message>
    <message>
        <source>Rate [Hz]</source>
        <translation>Rate [Hz]</translation>
    </message>
    <message>
        <source>Between rows</source>
        <translation>Zwischen Zeilen</translation>
    </message>
    <message>
        <source>Fastest command</source>
        <translation>Schnellster Sollwert</translation>
    </message>
    <message>
        <source>lowest</source>
        <translation>kleinster Wert</translation>
    </message>
    <message>
        <source>highest</source>
        <translation>größter Wert</translation>
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
        <source>predicted error</source>
        <translation>erwarteter Fehler</translation>
    </message>
    <message>
        <source>stop beyond</source>
        <translation>Halt über</translation>
    </message>
    <message>
        <source>range {low} … {high}</source>
        <translation>Bereich {low} … {high}</translation>
    </message>
    <message>
        <source>{rms} rms, {peak} peak</source>
        <translation>{rms} effektiv, {peak} Spitze</translation>
    </message>
    <message>
        <source>{text!r} is no bound: type a number above 0 in {unit}, with a decimal point, or nothing</source>
        <translation>{text!r} ist keine Grenze: eine Zahl über 0 in {unit} mit Dezimalpunkt eingeben, oder nichts</translation>
    </message>
    <message>
        <source>no bound is declared in the robot file</source>
        <translation>in der Roboterdatei ist keine Grenze angegeben</translation>
    </message>
    <message>
        <source>{share} of {bound:g} {unit}{per}</source>
        <translation>{share} von {bound:g} {unit}{per}</translation>
    </message>
    <message>
        <source>the model gives no prediction for this trajectory</source>
        <translation>das Modell gibt keine Vorhersage für diese Trajektorie</translation>
    </message>
    <message>
        <source>{rms:.3g} {unit} rms</source>
        <translation>{rms:.3g} {unit} effektiv</translation>
    </message>
    <message>
        <source>the model expects up to {peak:.3g} {unit} between command and position</source>
        <translation>das Modell erwartet bis {peak:.3g} {unit} zwischen Sollwert und Position</translation>
    </message>
    <message>
        <source>no trajectory is loaded</source>
        <translation>keine Trajektorie geladen</translation>
    </message>
    <message>
        <source>the dry run does not allow it</source>
        <translation>der Probelauf erlaubt es nicht</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>End</source>
        <translation>Ende</translation>
    </message>
    <message>
        <source>◂ Step</source>
        <translation>◂ Schritt</translation>
    </message>
    <message>
        <source>Step ▸</source>
        <translation>Schritt ▸</translation>
    </message>
    <message>
        <source>Rows of a step</source>
        <translation>Zeilen je Schritt</translation>
    </message>
    <message>
        <source>How many rows of the trajectory a step goes, 1 to 1000</source>
        <translation>Wie viele Zeilen der Trajektorie ein Schritt geht, 1 bis 1000</translation>
    </message>
    <message>
        <source>1 row</source>
        <translation>1 Zeile</translation>
    </message>
    <message>
        <source>{rows} rows</source>
        <translation>{rows} Zeilen</translation>
    </message>
    <message>
        <source>Speed factor</source>
        <translation>Tempofaktor</translation>
    </message>
    <message>
        <source>Pace of the playback, {slowest:g} to {fastest:g} times that of the trajectory; a faster one is checked against all limits first. Changed in a pause, it holds from there on</source>
        <translation>Tempo der Wiedergabe, {slowest:g}- bis {fastest:g}-fach; ein schnelleres wird zuerst gegen alle Grenzen geprüft. In einer Pause geändert, gilt es von dort an</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>the axes still move</source>
        <translation>die Achsen bewegen sich noch</translation>
    </message>
    <message>
        <source>Play, pause, go on (Ctrl+P)</source>
        <translation>Abspielen, Pause, weiter (Strg+P)</translation>
    </message>
    <message>
        <source>nothing plays</source>
        <translation>nichts wird abgespielt</translation>
    </message>
    <message>
        <source>Stop, and begin anew next</source>
        <translation>Anhalten; danach von vorn</translation>
    </message>
    <message>
        <source>a trajectory is playing</source>
        <translation>eine Trajektorie wird abgespielt</translation>
    </message>
    <message>
        <source>Go to the next rows at the axes&apos; own speed, and rest there</source>
        <translation>Zu den nächsten Zeilen im eigenen Tempo der Achsen fahren und dort ruhen</translation>
    </message>
    <message>
        <source>nothing is paused</source>
        <translation>nichts ist pausiert</translation>
    </message>
    <message>
        <source>row {row} of {rows}</source>
        <translation>Z. {row}/{rows}</translation>
    </message>
    <message>
        <source>before its first row</source>
        <translation>vor Zeile 1</translation>
    </message>
    <message>
        <source>paused, </source>
        <translation>Pause, </translation>
    </message>
    <message>
        <source>{paused}{row}, {left_s:.1f} s left</source>
        <translation>{paused}{row}, noch {left_s:.1f} s</translation>
    </message>
</context>
</TS>
