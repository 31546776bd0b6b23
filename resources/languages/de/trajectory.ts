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
        <source>Load …</source>
        <translation>Laden …</translation>
    </message>
    <message>
        <source>Resample …</source>
        <translation>Abtastung …</translation>
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
        <source>from {begin:.6g} s</source>
        <translation>ab {begin:.6g} s</translation>
    </message>
    <message>
        <source> (and {n} more)</source>
        <translation> (und {n} weitere)</translation>
    </message>
    <message>
        <source>Resample the loaded trajectory to another rate, in Hz</source>
        <translation>Die geladene Trajektorie auf eine andere Rate abtasten, in Hz</translation>
    </message>
    <message>
        <source>Teach</source>
        <translation>Einlernen</translation>
    </message>
    <message>
        <source>Dry run: {verdict}. The tip stays inside its bounds.</source>
        <translation>Probelauf: {verdict}. Die Spitze bleibt innerhalb ihrer Grenzen.</translation>
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
        <source>Passes</source>
        <translation>Durchgänge</translation>
    </message>
    <message>
        <source>{name}, resampled</source>
        <translation>{name}, neu abgetastet</translation>
    </message>
    <message>
        <source>{moved}: Resume asks how to go on.</source>
        <translation>{moved}: Weiter fragt, wie es weitergeht.</translation>
    </message>
    <message>
        <source>Distance between model and machine: {parts}</source>
        <translation>Abstand zwischen Modell und Maschine: {parts}</translation>
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
        <source>rate: {text!r} is not a number; enter one in Hz, such as 1000</source>
        <translation>Rate: {text!r} ist keine Zahl; eine in Hz eingeben, etwa 1000</translation>
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
        <translation>{rms} rms, {peak} maximal</translation>
    </message>
    <message>
        <source>{share} of {bound}</source>
        <translation>{share} von {bound}</translation>
    </message>
    <message>
        <source>{rms} rms</source>
        <translation>{rms} rms</translation>
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
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>the dry run of {name} is under way</source>
        <translation>der Probelauf von {name} läuft</translation>
    </message>
    <message>
        <source>Dry run of {name} …</source>
        <translation>Probelauf von {name} …</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Weiter</translation>
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
        <translation>Bahn der Spitze</translation>
    </message>
    <message>
        <source>Path of the tip from above and from the side; dot: where the tip is; dashed: approach to the first row; red: forbidden by floor, objective or radius; frame: reach of the axes.</source>
        <translation>Weg der Spitze von oben und von der Seite; Punkt: wo die Spitze ist; gestrichelt: Anfahrt zur ersten Zeile; rot: durch Boden, Objektiv oder Radius verboten; Rahmen: Reichweite der Achsen.</translation>
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
        <source>speed [%]</source>
        <translation>Tempo [%]</translation>
    </message>
    <message>
        <source>pause [s]</source>
        <translation>Pause [s]</translation>
    </message>
    <message>
        <source>Taught points</source>
        <translation>Eingelernte Punkte</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Make trajectory</source>
        <translation>Trajektorie erzeugen</translation>
    </message>
    <message>
        <source>Replace the selected point with the present target of the machine</source>
        <translation>Den gewählten Punkt durch das aktuelle Ziel der Maschine ersetzen</translation>
    </message>
    <message>
        <source>{n} taught points</source>
        <translation>{n} eingelernte Punkte</translation>
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
    <message>
        <source>Add point</source>
        <translation>Punkt hinzufügen</translation>
    </message>
    <message>
        <source>Replace</source>
        <translation>Ersetzen</translation>
    </message>
    <message>
        <source>the position is unknown</source>
        <translation>die Position ist unbekannt</translation>
    </message>
    <message>
        <source>select a point first</source>
        <translation>erst einen Punkt auswählen</translation>
    </message>
    <message>
        <source>add two points or more</source>
        <translation>zwei oder mehr Punkte hinzufügen</translation>
    </message>
    <message>
        <source>Add the present target of the machine after the selected point</source>
        <translation>Das aktuelle Ziel der Maschine hinter dem gewählten Punkt hinzufügen</translation>
    </message>
    <message>
        <source>Remove the selected point</source>
        <translation>Den gewählten Punkt entfernen</translation>
    </message>
    <message>
        <source>Make a trajectory from the points and check it in a dry run</source>
        <translation>Aus den Punkten eine Trajektorie erzeugen und im Probelauf prüfen</translation>
    </message>
    <message>
        <source>Click to switch between the whole reach and the path.</source>
        <translation>Ein Klick wechselt zwischen ganzer Reichweite und Bahn.</translation>
    </message>
    <message>
        <source>the dry run found a problem</source>
        <translation>der Probelauf fand ein Problem</translation>
    </message>
    <message>
        <source>the axes are still moving</source>
        <translation>die Achsen bewegen sich noch</translation>
    </message>
    <message>
        <source>Play, pause or resume (Ctrl+P); the axes first move to the first row</source>
        <translation>Abspielen, anhalten oder fortsetzen (Strg+P); die Achsen fahren zuerst zur ersten Zeile</translation>
    </message>
    <message>
        <source>Move to the next rows at the speed of the axes and stop there</source>
        <translation>Mit der Geschwindigkeit der Achsen zu den nächsten Zeilen fahren und dort anhalten</translation>
    </message>
    <message>
        <source>Rows of the trajectory per step, 1 to 1000</source>
        <translation>Zeilen der Trajektorie je Schritt, 1 bis 1000</translation>
    </message>
    <message>
        <source>Speed of the playback, {slowest:g} to {fastest:g} times that of the trajectory; a higher one is checked against all limits first. A change during a pause applies from there on</source>
        <translation>Tempo der Wiedergabe, {slowest:g}- bis {fastest:g}-fach; ein höheres wird zuerst gegen alle Grenzen geprüft. Eine Änderung in einer Pause gilt von dort an</translation>
    </message>
    <message>
        <source>cubic – smooth, may overshoot the rows</source>
        <translation>kubisch – glatt, kann über die Zeilen hinausschwingen</translation>
    </message>
    <message>
        <source>No trajectory is loaded. Load one to see its demands on each axis before playing it.</source>
        <translation>Keine Trajektorie geladen. Eine laden, um vor dem Abspielen zu sehen, was sie von jeder Achse verlangt.</translation>
    </message>
    <message>
        <source>The playback pauses when readings differ from the model by more than this for 20 ms; double-click to change it, empty: no bound</source>
        <translation>Die Wiedergabe pausiert, wenn Messwerte 20 ms lang stärker vom Modell abweichen; Doppelklick zum Ändern, leer: keine Grenze</translation>
    </message>
    <message>
        <source>Load a trajectory from a text file and check it on the model (Ctrl+T)</source>
        <translation>Eine Trajektorie aus einer Textdatei laden und am Modell prüfen (Strg+T)</translation>
    </message>
    <message>
        <source>Make a trajectory from taught points</source>
        <translation>Eine Trajektorie aus eingelernten Punkten erzeugen</translation>
    </message>
    <message>
        <source>Start of the playback in seconds</source>
        <translation>Beginn der Wiedergabe in Sekunden</translation>
    </message>
    <message>
        <source>Dry run: within all limits of the axes and of the tip.</source>
        <translation>Probelauf: innerhalb aller Grenzen der Achsen und der Spitze.</translation>
    </message>
    <message>
        <source>Number of passes, 1 to {most}; the trajectory must end where it starts</source>
        <translation>Anzahl der Durchgänge, 1 bis {most}; die Trajektorie muss enden, wo sie beginnt</translation>
    </message>
    <message>
        <source>Start of the first pass, 0 to {last:.7g} s, before the last row</source>
        <translation>Beginn des ersten Durchgangs, 0 bis {last:.7g} s, vor der letzten Zeile</translation>
    </message>
    <message>
        <source>{n} points: a trajectory needs two or more; add another</source>
        <translation>{n} Punkte: eine Trajektorie braucht zwei oder mehr; noch einen hinzufügen</translation>
    </message>
    <message>
        <source>point {number}: the speed of {speed} % must be above 0 and at most 100 %</source>
        <translation>Punkt {number}: das Tempo von {speed} % muss über 0 und höchstens 100 % sein</translation>
    </message>
    <message>
        <source>point {number}: the pause of {pause} s must be 0 to {most} s</source>
        <translation>Punkt {number}: die Pause von {pause} s muss 0 bis {most} s sein</translation>
    </message>
    <message>
        <source>the points take more than {hours} h; shorten pauses or increase speeds</source>
        <translation>die Punkte dauern mehr als {hours} h; Pausen kürzen oder schneller fahren</translation>
    </message>
    <message>
        <source>the robot file states no bound</source>
        <translation>die Roboterdatei nennt keine Grenze</translation>
    </message>
    <message>
        <source>the model predicts up to {peak} between command and position</source>
        <translation>das Modell sagt bis {peak} zwischen Sollwert und Position voraus</translation>
    </message>
    <message>
        <source>{text!r} is not a bound: enter a number above 0 in {unit} with a decimal point, or leave it empty</source>
        <translation>{text!r} ist keine Grenze: eine Zahl über 0 in {unit} mit Dezimalkomma eingeben oder leer lassen</translation>
    </message>
    <message>
        <source>Speed limit</source>
        <translation>Geschwindigkeitsgrenze</translation>
    </message>
    <message>
        <source>the trajectory reaches {speed}</source>
        <translation>die Trajektorie erreicht {speed}</translation>
    </message>
    <message>
        <source>The robot file states no speed limit for these axes. Enter the maximum speed at which each may move.</source>
        <translation>Die Roboterdatei nennt für diese Achsen keine Geschwindigkeitsgrenze. Geben Sie für jede die höchste Geschwindigkeit ein, mit der sie fahren darf.</translation>
    </message>
    <message>
        <source>Maximum speed of {axis}</source>
        <translation>Höchste Geschwindigkeit von {axis}</translation>
    </message>
    <message>
        <source>In {unit}, above 0</source>
        <translation>In {unit}, größer als 0</translation>
    </message>
    <message>
        <source>another trajectory was loaded meanwhile</source>
        <translation>inzwischen wurde eine andere Trajektorie geladen</translation>
    </message>
</context>
</TS>
