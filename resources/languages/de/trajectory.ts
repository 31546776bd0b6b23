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
        <source>Resample …</source>
        <translation>Rate …</translation>
    </message>
    <message>
        <source>{name} – {seconds:.3f} s, {rows} rows</source>
        <translation>{name} – {seconds:.3f} s, {rows} Zeilen</translation>
    </message>
    <message>
        <source>Not playable from here: {why}</source>
        <translation>Von hier aus nicht abspielbar: {why}</translation>
    </message>
    <message>
        <source>Dry run: inside all limits of the axes and of the tip.</source>
        <translation>Probelauf: innerhalb aller Grenzen der Achsen und der Spitze.</translation>
    </message>
    <message>
        <source>from {begin:.6g} s</source>
        <translation>ab {begin:.6g} s</translation>
    </message>
    <message>
        <source> (and {n} more)</source>
        <translation> (und {n} weitere)</translation>
    </message>
    <message>
        <source>Load a trajectory from a text file and try it on the model (Ctrl+T)</source>
        <translation>Eine Trajektorie aus einer Textdatei laden und am Modell erproben (Strg+T)</translation>
    </message>
    <message>
        <source>Resample the loaded trajectory to another rate, in Hz</source>
        <translation>Die geladene Trajektorie auf eine andere Rate abtasten, in Hz</translation>
    </message>
    <message>
        <source>Teach</source>
        <translation>Lernen</translation>
    </message>
    <message>
        <source>Make a trajectory of points where the machine has been</source>
        <translation>Eine Trajektorie aus Punkten machen, an denen die Maschine war</translation>
    </message>
    <message>
        <source>Not playable: {objection}{more}</source>
        <translation>Nicht abspielbar: {objection}{more}</translation>
    </message>
    <message>
        <source>from </source>
        <translation>ab </translation>
    </message>
    <message>
        <source>Begin of the playback in seconds</source>
        <translation>Beginn der Wiedergabe in Sekunden</translation>
    </message>
    <message>
        <source>Passes</source>
        <translation>Durchgänge</translation>
    </message>
    <message>
        <source>How often it is played, 1 to {most}: it must end where it begins</source>
        <translation>Wie oft abgespielt wird, 1 bis {most}: sie muss enden, wo sie beginnt</translation>
    </message>
    <message>
        <source>Where the first pass begins, 0 to {last:.7g} s: before its last row</source>
        <translation>Wo der erste Durchgang beginnt, 0 bis {last:.7g} s: vor der letzten Zeile</translation>
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
        <translation>tiefster</translation>
    </message>
    <message>
        <source>highest</source>
        <translation>höchster</translation>
    </message>
    <message>
        <source>speed</source>
        <translation>Tempo</translation>
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
        <translation>{text!r} ist keine Grenze: eine Zahl über 0 in {unit} mit Dezimalkomma eingeben, oder nichts</translation>
    </message>
    <message>
        <source>no bound is declared in the robot file</source>
        <translation>in der Roboterdatei ist keine Grenze angegeben</translation>
    </message>
    <message>
        <source>{share} of {bound}</source>
        <translation>{share} von {bound}</translation>
    </message>
    <message>
        <source>{rms} rms</source>
        <translation>{rms} effektiv</translation>
    </message>
    <message>
        <source>the model expects up to {peak} between command and position</source>
        <translation>das Modell erwartet bis {peak} zwischen Sollwert und Position</translation>
    </message>
    <message>
        <source>the model gives no prediction for this trajectory</source>
        <translation>das Modell gibt keine Vorhersage für diese Trajektorie</translation>
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
        <source>Resume</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>the axes still move</source>
        <translation>die Achsen bewegen sich noch</translation>
    </message>
    <message>
        <source>Play, pause or resume (Ctrl+P); the axes first go to the first row</source>
        <translation>Abspielen, anhalten oder fortsetzen (Strg+P); die Achsen fahren zuerst zur ersten Zeile</translation>
    </message>
    <message>
        <source>nothing is playing</source>
        <translation>nichts wird abgespielt</translation>
    </message>
    <message>
        <source>Stop; the next playback starts from the beginning</source>
        <translation>Anhalten; das nächste Abspielen beginnt von vorn</translation>
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
    <message>
        <source>Path of the tip</source>
        <translation>Weg der Spitze</translation>
    </message>
    <message>
        <source>The tip&apos;s path from above and from the side; dashed: the way to its first row. Red is forbidden: floor, objective, radius. The frame is what the axes can reach.</source>
        <translation>Der Weg der Spitze von oben und von der Seite; gestrichelt: der Weg zur ersten Zeile. Rot ist verboten: Boden, Objektiv, Radius. Der Rahmen ist, was die Achsen erreichen.</translation>
    </message>
    <message>
        <source>Click to see all of the reach, or the path alone.</source>
        <translation>Klicken zeigt die ganze Reichweite oder den Weg allein.</translation>
    </message>
    <message>
        <source>{share:.0f} % of the rows are forbidden</source>
        <translation>{share:.0f} % der Zeilen sind verboten</translation>
    </message>
    <message>
        <source>above: x, y</source>
        <translation>von oben: x, y</translation>
    </message>
    <message>
        <source>side: x, z</source>
        <translation>Seite: x, z</translation>
    </message>
    <message>
        <source>{n} points: a trajectory needs two or more; take another</source>
        <translation>{n} Punkte: eine Trajektorie braucht zwei oder mehr; noch einen nehmen</translation>
    </message>
    <message>
        <source>the points take more than {hours} h; shorten pauses, or go faster</source>
        <translation>die Punkte dauern mehr als {hours} h; Pausen kürzen, oder schneller fahren</translation>
    </message>
    <message>
        <source>point {number}: a speed of {speed} %: must be above 0 and at most 100</source>
        <translation>Punkt {number}: ein Tempo von {speed} %: muss über 0 und höchstens 100 sein</translation>
    </message>
    <message>
        <source>point {number}: a pause of {pause} s: must be 0 to {most} s</source>
        <translation>Punkt {number}: eine Pause von {pause} s: muss 0 bis {most} s sein</translation>
    </message>
    <message>
        <source>speed [%]</source>
        <translation>Tempo [%]</translation>
    </message>
    <message>
        <source>pause [s]</source>
        <translation>Pause [s]</translation>
    </message>
    <message>
        <source>Taught points</source>
        <translation>Geteachte Punkte</translation>
    </message>
    <message>
        <source>Take point</source>
        <translation>Punkt nehmen</translation>
    </message>
    <message>
        <source>Take anew</source>
        <translation>Neu nehmen</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Make trajectory</source>
        <translation>Trajektorie machen</translation>
    </message>
    <message>
        <source>its place is not known</source>
        <translation>ihr Ort ist nicht bekannt</translation>
    </message>
    <message>
        <source>mark a point first</source>
        <translation>erst einen Punkt markieren</translation>
    </message>
    <message>
        <source>take two points or more</source>
        <translation>zwei oder mehr Punkte nehmen</translation>
    </message>
    <message>
        <source>Add where the machine is sent now, behind the marked point</source>
        <translation>Hinzufügen, wohin die Maschine jetzt geschickt ist, hinter dem markierten Punkt</translation>
    </message>
    <message>
        <source>Put the marked point where the machine is sent now</source>
        <translation>Den markierten Punkt dorthin setzen, wohin die Maschine jetzt geschickt ist</translation>
    </message>
    <message>
        <source>Remove the marked point</source>
        <translation>Den markierten Punkt entfernen</translation>
    </message>
    <message>
        <source>Make a trajectory of the points; the dry run tries it</source>
        <translation>Eine Trajektorie aus den Punkten machen; der Trockenlauf probiert sie</translation>
    </message>
    <message>
        <source>{n} taught points</source>
        <translation>{n} geteachte Punkte</translation>
    </message>
    <message>
        <source>must be {low} to {high}</source>
        <translation>muss {low} bis {high} sein</translation>
    </message>
    <message>
        <source>must be above 0 and at most 100 %</source>
        <translation>muss über 0 und höchstens 100 % sein</translation>
    </message>
    <message>
        <source>must be 0 to {most} s</source>
        <translation>muss 0 bis {most} s sein</translation>
    </message>
    <message>
        <source>Point {number}, {column}: {text!r}: {bound}</source>
        <translation>Punkt {number}, {column}: {text!r}: {bound}</translation>
    </message>
</context>
</TS>
