<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>help</name>
    <message>
        <source>serve virtual boards that behave like the real ones, with the robot&apos;s model behind them</source>
        <translation>stellt virtuelle Karten bereit, die sich wie die echten verhalten, mit dem Modell des Roboters dahinter</translation>
    </message>
    <message>
        <source>Serve the boards of a robot, with its model and effects behind them, on pseudo-terminals or on sockets of this computer, at the byte rate of a real serial line. With two ports, each board has its own line. With one port and more than three axes, both boards share the line as a bus. Commands on standard input, one per line, inject faults: drop N, double N, corrupt N, garbage N, delay T ms (each towards &apos;board&apos; or &apos;host&apos;), silence T s, space T s, reset BOARD, brown-out BOARD, freeze AXIS, thaw AXIS, lose AXIS N, joystick X Y Z BUTTONS.</source>
        <translation>Stellt die Karten eines Roboters, mit seinem Modell und dessen Effekten dahinter, an Pseudoterminals oder Sockets dieses Rechners bereit, mit der Byterate einer echten seriellen Leitung. Bei zwei Anschlüssen hat jede Karte ihre eigene Leitung. Bei einem Anschluss und mehr als drei Achsen teilen sich beide Karten die Leitung als Bus. Befehle auf der Standardeingabe, einer je Zeile, erzeugen Fehler: drop N, double N, corrupt N, garbage N, delay T ms (jeweils in Richtung &apos;board&apos; oder &apos;host&apos;), silence T s, space T s, reset BOARD, brown-out BOARD, freeze AXIS, thaw AXIS, lose AXIS N, joystick X Y Z BUTTONS.</translation>
    </message>
    <message>
        <source>path of a symbolic link to the pseudo-terminal</source>
        <translation>Pfad eines symbolischen Links auf das Pseudoterminal</translation>
    </message>
    <message>
        <source>listen on this address instead; only 127.0.0.1 or ::1, port 0 for any free port</source>
        <translation>stattdessen an dieser Adresse lauschen; nur 127.0.0.1 oder ::1, Port 0 für einen beliebigen freien</translation>
    </message>
    <message>
        <source>serve both boards on one line</source>
        <translation>beide Karten an einer Leitung bereitstellen</translation>
    </message>
    <message>
        <source>bit rate of the lines, 125000 or 9600 (default: %(default)s)</source>
        <translation>Bitrate der Leitungen, 125000 oder 9600 (Vorgabe: %(default)s)</translation>
    </message>
    <message>
        <source>E clock of the boards&apos; microcontrollers, MHz; 2 halves their tick rate (default: 4)</source>
        <translation>E-Takt der Mikrocontroller auf den Karten, MHz; 2 halbiert ihre Tickrate (Vorgabe: 4)</translation>
    </message>
    <message>
        <source>transmit bytes without delay</source>
        <translation>Bytes ohne Verzögerung übertragen</translation>
    </message>
    <message>
        <source>seed of noise and faults (default: 0)</source>
        <translation>Startwert von Rauschen und Fehlern (Vorgabe: 0)</translation>
    </message>
    <message>
        <source>start homed and without a fault</source>
        <translation>referenziert und ohne Fehler beginnen</translation>
    </message>
    <message>
        <source>average number of random line faults per second (default: 0)</source>
        <translation>mittlere Zahl zufälliger Leitungsfehler je Sekunde (Vorgabe: 0)</translation>
    </message>
    <message>
        <source>end when standard input closes</source>
        <translation>enden, sobald die Standardeingabe geschlossen wird</translation>
    </message>
    <message>
        <source>calibrate the sensor of an axis against a laser</source>
        <translation>kalibriert den Sensor einer Achse gegen einen Laser</translation>
    </message>
    <message>
        <source>Calibrate the sensor of an axis against a laser: &quot;plan&quot; writes the motion, &quot;fit&quot; makes a calibration from records with meas and ref of the axis, &quot;run&quot; does both on the simulator, &quot;show&quot; prints a calibration, &quot;list&quot; prints the stored ones.</source>
        <translation>Kalibriert den Sensor einer Achse gegen einen Laser: „plan“ schreibt die Bewegung, „fit“ erstellt aus Aufzeichnungen mit meas und ref der Achse eine Kalibrierung, „run“ erledigt beides am Simulator, „show“ zeigt eine Kalibrierung, „list“ die gespeicherten.</translation>
    </message>
    <message>
        <source>print the contents of a calibration</source>
        <translation>zeigt den Inhalt einer Kalibrierung</translation>
    </message>
    <message>
        <source>list the stored calibrations of a robot</source>
        <translation>listet die gespeicherten Kalibrierungen eines Roboters auf</translation>
    </message>
    <message>
        <source>write the motion that shows the errors of a sensor</source>
        <translation>schreibt die Bewegung, die die Fehler eines Sensors zeigt</translation>
    </message>
    <message>
        <source>make a calibration from records</source>
        <translation>erstellt aus Aufzeichnungen eine Kalibrierung</translation>
    </message>
    <message>
        <source>separate record of the laser, one for each RECORD; the motion aligns their clocks</source>
        <translation>getrennte Aufzeichnung des Lasers, eine je RECORD; die Bewegung gleicht die Uhren ab</translation>
    </message>
    <message>
        <source>calibrate on the simulator, with the effects of the robot file</source>
        <translation>kalibriert am Simulator, mit den Effekten der Roboterdatei</translation>
    </message>
    <message>
        <source>seed of the noise</source>
        <translation>Startwert des Rauschens</translation>
    </message>
    <message>
        <source>write the record as well</source>
        <translation>auch die Aufzeichnung schreiben</translation>
    </message>
    <message>
        <source>runs of the motion (default: %(default)s)</source>
        <translation>Durchläufe der Bewegung (Vorgabe: %(default)s)</translation>
    </message>
    <message>
        <source>target positions of a stepper axis (default: %(default)s)</source>
        <translation>Zielpositionen einer Schrittmotorachse (Vorgabe: %(default)s)</translation>
    </message>
    <message>
        <source>rows per second (default: %(default)g)</source>
        <translation>Zeilen je Sekunde (Vorgabe: %(default)g)</translation>
    </message>
    <message>
        <source>seed of the target positions</source>
        <translation>Startwert der Zielpositionen</translation>
    </message>
    <message>
        <source>the laser&apos;s zero is arbitrary: keep the reading at mid-travel</source>
        <translation>der Nullpunkt des Lasers ist beliebig: den Messwert in der Mitte des Bereichs beibehalten</translation>
    </message>
    <message>
        <source>write the calibration to this file</source>
        <translation>die Kalibrierung in diese Datei schreiben</translation>
    </message>
    <message>
        <source>keep the calibration in the user&apos;s folder</source>
        <translation>die Kalibrierung im Ordner des Benutzers aufbewahren</translation>
    </message>
    <message>
        <source>folder of the calibrations (default: the user&apos;s own)</source>
        <translation>Ordner der Kalibrierungen (Vorgabe: der des Benutzers)</translation>
    </message>
    <message>
        <source>print JSON in SI units</source>
        <translation>JSON in SI-Einheiten ausgeben</translation>
    </message>
    <message>
        <source>compare the model with a record of the real machine</source>
        <translation>vergleicht das Modell mit einer Aufzeichnung der echten Maschine</translation>
    </message>
    <message>
        <source>Simulate the nominal model with the commands of a record, and print how far the real machine deviates from it in each measured signal (u, ref, meas). With --with, print how far two runs of the machine differ.</source>
        <translation>Simuliert das nominale Modell mit den Sollwerten einer Aufzeichnung und gibt aus, wie weit die echte Maschine in jedem gemessenen Signal (u, ref, meas) davon abweicht. Mit --with: wie weit zwei Läufe der Maschine voneinander abweichen.</translation>
    </message>
    <message>
        <source>a record file (.csv, .gz)</source>
        <translation>eine Datei mit einer Aufzeichnung (.csv, .gz)</translation>
    </message>
    <message>
        <source>compare with this run of the machine instead of the model</source>
        <translation>mit diesem Lauf der Maschine statt mit dem Modell vergleichen</translation>
    </message>
    <message>
        <source>fit these parameters by least squares first: gain, offset</source>
        <translation>diese Parameter zuerst nach kleinsten Quadraten anpassen: gain, offset</translation>
    </message>
    <message>
        <source>write the figures as JSON (&apos;-&apos; prints them)</source>
        <translation>die Zahlen als JSON schreiben (&apos;-&apos; gibt sie aus)</translation>
    </message>
    <message>
        <source>draw a picture (.svg .png .pdf)</source>
        <translation>ein Bild zeichnen (.svg .png .pdf)</translation>
    </message>
    <message>
        <source>train inverse models of hysteresis, check them, and apply them to trajectories</source>
        <translation>trainiert inverse Modelle der Hysterese, prüft sie und wendet sie auf Trajektorien an</translation>
    </message>
    <message>
        <source>Learn which commands bring a piezo axis to the desired positions: an ANFIS, the modified and the classical Prandtl–Ishlinskii inverse and a straight line, compared with each other.</source>
        <translation>Lernt, welche Sollwerte eine Piezoachse an die gewünschten Positionen bringen: ein ANFIS, die modifizierte und die klassische Prandtl-Ishlinskii-Inverse und eine Gerade, miteinander verglichen.</translation>
    </message>
    <message>
        <source>write a trajectory with the commands that compensate its hysteresis</source>
        <translation>schreibt eine Trajektorie mit Sollwerten, die ihre Hysterese kompensieren</translation>
    </message>
    <message>
        <source>Convert a trajectory with the recommended inverse of a file, check the result against the robot&apos;s limits, and write it, so that any player can play it. The axis must start at rest after a rise from the low end of its range.</source>
        <translation>Wandelt eine Trajektorie mit der empfohlenen Inversen einer Datei um, prüft das Ergebnis gegen die Grenzen des Roboters und schreibt es, sodass jeder Abspieler es abspielen kann. Die Achse muss in Ruhe beginnen, nach einem Anstieg vom unteren Ende ihres Bereichs.</translation>
    </message>
    <message>
        <source>file written by &apos;rotemina compensate train&apos;</source>
        <translation>Datei, die &apos;rotemina compensate train&apos; geschrieben hat</translation>
    </message>
    <message>
        <source>compare the commands of inverses for measured positions with the recorded ones</source>
        <translation>vergleicht die Sollwerte von Inversen zu gemessenen Positionen mit den aufgezeichneten</translation>
    </message>
    <message>
        <source>Feed the positions of records to each inverse of a file, and print the difference between its command and the recorded one. If the history is unknown, rows count only after the first sweep over the whole range.</source>
        <translation>Gibt die Positionen von Aufzeichnungen in jede Inverse einer Datei und zeigt den Unterschied zwischen ihrem Sollwert und dem aufgezeichneten. Ist die Vorgeschichte unbekannt, zählen Zeilen erst nach dem ersten Durchlauf des ganzen Bereichs.</translation>
    </message>
    <message>
        <source>train the inverses of an axis with records, or with the simulator</source>
        <translation>trainiert die Inversen einer Achse mit Aufzeichnungen oder mit dem Simulator</translation>
    </message>
    <message>
        <source>Train inverses of all kinds with records that have cmd and meas (or ref), compare them on rows that were not used for training, and recommend one, with the reason.</source>
        <translation>Trainiert Inverse aller Arten mit Aufzeichnungen, die cmd und meas (oder ref) haben, vergleicht sie an Zeilen, die nicht zum Training dienten, und empfiehlt eine mit Begründung.</translation>
    </message>
    <message>
        <source>axis to be compensated (default: the only piezo axis of the record)</source>
        <translation>Achse, die kompensiert wird (Vorgabe: die einzige Piezoachse der Aufzeichnung)</translation>
    </message>
    <message>
        <source>compare on these records (default: the last quarter of each record)</source>
        <translation>an diesen Aufzeichnungen vergleichen (Vorgabe: letztes Viertel jeder Aufzeichnung)</translation>
    </message>
    <message>
        <source>use no records: move the axis on the simulator</source>
        <translation>keine Aufzeichnungen: die Achse am Simulator bewegen</translation>
    </message>
    <message>
        <source>simulate with the effects of this robot file instead</source>
        <translation>stattdessen mit den Effekten dieser Roboterdatei simulieren</translation>
    </message>
    <message>
        <source>seed of the simulated motion and noise (default: 0)</source>
        <translation>Startwert der simulierten Bewegung und des Rauschens (Vorgabe: 0)</translation>
    </message>
    <message>
        <source>convert a trajectory or record: units, sampling, header</source>
        <translation>wandelt eine Trajektorie oder Aufzeichnung um: Einheiten, Abtastung, Kopfzeile</translation>
    </message>
    <message>
        <source>Read a trajectory or record and write it again: in other units, resampled, or as plain columns without a header.</source>
        <translation>Liest eine Trajektorie oder Aufzeichnung und schreibt sie neu: in anderen Einheiten, neu abgetastet oder als Spalten ohne Kopfzeile.</translation>
    </message>
    <message>
        <source>units of lengths and angles in the output (default: m, rad)</source>
        <translation>Einheiten der Längen und Winkel in der Ausgabe (Vorgabe: m, rad)</translation>
    </message>
    <message>
        <source>write the numbers alone</source>
        <translation>nur die Zahlen schreiben</translation>
    </message>
    <message>
        <source>resample at this rate</source>
        <translation>mit dieser Rate neu abtasten</translation>
    </message>
    <message>
        <source>interpolation between rows (default: hold, as a device does)</source>
        <translation>Interpolation zwischen Zeilen (Vorgabe: hold, wie ein Gerät)</translation>
    </message>
    <message>
        <source>check this computer, and advise what to do</source>
        <translation>prüft diesen Rechner und rät, was zu tun ist</translation>
    </message>
    <message>
        <source>Check Python, packages, Qt, permissions of serial ports and joysticks, folders, disk and clock. No board is opened except by --port. Exit status: 0 the program runs (limits are reported), 1 something is broken.</source>
        <translation>Prüft Python, Pakete, Qt, Rechte an seriellen Anschlüssen und Joysticks, Ordner, Festplatte und Uhr. Keine Karte wird geöffnet, außer durch --port. Rückgabewert: 0 das Programm läuft (Einschränkungen werden gemeldet), 1 etwas ist defekt.</translation>
    </message>
    <message>
        <source>print the findings as JSON</source>
        <translation>die Befunde als JSON ausgeben</translation>
    </message>
    <message>
        <source>test whether this serial port reaches the bit rate of the boards, 125000 baud; this may reset the connected device</source>
        <translation>prüfen, ob dieser serielle Anschluss die Bitrate der Karten erreicht, 125000 Baud; das kann das angeschlossene Gerät zurücksetzen</translation>
    </message>
    <message>
        <source>list drivers, and check whether they meet the driver contract</source>
        <translation>listet Treiber auf und prüft, ob sie die Treiber-Vereinbarung einhalten</translation>
    </message>
    <message>
        <source>List the installed drivers, both built-in and from plugins.</source>
        <translation>Listet die installierten Treiber auf, eingebaute und solche aus Plugins.</translation>
    </message>
    <message>
        <source>print one line for each driver (default)</source>
        <translation>gibt eine Zeile je Treiber aus (Vorgabe)</translation>
    </message>
    <message>
        <source>check a driver against the contract</source>
        <translation>prüft, ob ein Treiber die Vereinbarung einhält</translation>
    </message>
    <message>
        <source>Open a driver and measure whether it meets the contract. On a real device, only the checks without motion run unless --move is given. Exit status: 0 all passed, 1 a check failed.</source>
        <translation>Öffnet einen Treiber und misst, ob er die Vereinbarung einhält. An einem echten Gerät laufen ohne --move nur die Prüfungen, die nichts bewegen. Rückgabewert: 0 alle bestanden, 1 eine nicht bestanden.</translation>
    </message>
    <message>
        <source>a setting of the driver (may be repeated)</source>
        <translation>eine Einstellung des Treibers (mehrfach möglich)</translation>
    </message>
    <message>
        <source>only this check (may be repeated)</source>
        <translation>nur diese Prüfung (mehrfach möglich)</translation>
    </message>
    <message>
        <source>let the axes of a real device move</source>
        <translation>die Achsen eines echten Geräts bewegen lassen</translation>
    </message>
    <message>
        <source>also print what each check requires</source>
        <translation>auch ausgeben, was jede Prüfung verlangt</translation>
    </message>
    <message>
        <source>list, show and check the effects that a simulated machine may have</source>
        <translation>listet die Effekte auf, die eine simulierte Maschine haben kann, zeigt und prüft sie</translation>
    </message>
    <message>
        <source>List the installed effects, both built-in and from plugins.</source>
        <translation>Listet die installierten Effekte auf, eingebaute und solche aus Plugins.</translation>
    </message>
    <message>
        <source>print one line for each effect (default)</source>
        <translation>gibt eine Zeile je Effekt aus (Vorgabe)</translation>
    </message>
    <message>
        <source>print equations, sources, and parameters on the axes of a robot</source>
        <translation>zeigt Gleichungen, Quellen und Parameter an den Achsen eines Roboters</translation>
    </message>
    <message>
        <source>measure whether effects match their descriptions</source>
        <translation>misst, ob Effekte ihrer Beschreibung entsprechen</translation>
    </message>
    <message>
        <source>Simulate each formulation on axes of the shipped robots, or of one robot, and compare it with its description. Exit status: 0 all passed, 1 a check failed.</source>
        <translation>Simuliert jede Formulierung an Achsen der mitgelieferten Roboter oder eines Roboters und vergleicht sie mit ihrer Beschreibung. Rückgabewert: 0 alle bestanden, 1 eine nicht bestanden.</translation>
    </message>
    <message>
        <source>effects to be checked (default: all)</source>
        <translation>Effekte, die geprüft werden (Vorgabe: alle)</translation>
    </message>
    <message>
        <source>a robot file, or a shipped robot, whose axes are used (default: all shipped ones)</source>
        <translation>eine Roboterdatei oder ein mitgelieferter Roboter, dessen Achsen dienen (Vorgabe: alle mitgelieferten)</translation>
    </message>
    <message>
        <source>print every check, not only the failed ones</source>
        <translation>alle Prüfungen ausgeben, nicht nur die nicht bestandenen</translation>
    </message>
    <message>
        <source>each way from the middle; %% of the range</source>
        <translation>nach beiden Seiten der Mitte; %% des Bereichs</translation>
    </message>
    <message>
        <source>middle of the motion; %% of the range</source>
        <translation>Mitte der Bewegung; %% des Bereichs</translation>
    </message>
    <message>
        <source>frequency of the wave, or clock of the PRBS</source>
        <translation>Frequenz der Schwingung oder Takt der PRBS</translation>
    </message>
    <message>
        <source>band of chirp or multisine, Hz</source>
        <translation>Band von Chirp oder Multisinus, Hz</translation>
    </message>
    <message>
        <source>duration, rounded to whole periods</source>
        <translation>Dauer, auf ganze Perioden gerundet</translation>
    </message>
    <message>
        <source>period of the multisine</source>
        <translation>Periode des Multisinus</translation>
    </message>
    <message>
        <source>leave out one odd line in N; 0: none</source>
        <translation>eine von N ungeraden Linien auslassen; 0: keine</translation>
    </message>
    <message>
        <source>multisine amplitudes proportional to f^P</source>
        <translation>Amplituden des Multisinus proportional zu f^P</translation>
    </message>
    <message>
        <source>frequency spacing of the chirp</source>
        <translation>Frequenzverlauf des Chirps</translation>
    </message>
    <message>
        <source>PRBS of 2^N - 1 chips</source>
        <translation>PRBS mit 2^N - 1 Takten</translation>
    </message>
    <message>
        <source>levels of the staircase</source>
        <translation>Stufen der Treppe</translation>
    </message>
    <message>
        <source>rest between moves</source>
        <translation>Ruhe zwischen Bewegungen</translation>
    </message>
    <message>
        <source>rise time of a step</source>
        <translation>Anstiegszeit eines Sprungs</translation>
    </message>
    <message>
        <source>jerk limit of a step</source>
        <translation>Grenze für den Ruck eines Sprungs</translation>
    </message>
    <message>
        <source>repetitions of the steps</source>
        <translation>Wiederholungen der Sprünge</translation>
    </message>
    <message>
        <source>speeds of sweeps, joined by &apos;:&apos;; %% of the speed limit</source>
        <translation>Geschwindigkeiten der Durchläufe, durch &apos;:&apos; getrennt; %% der Höchstgeschwindigkeit</translation>
    </message>
    <message>
        <source>end one row before the first row repeats, and mark the file as periodic</source>
        <translation>eine Zeile vor der Wiederholung der ersten enden und die Datei als periodisch kennzeichnen</translation>
    </message>
    <message>
        <source>let the triangle wave grow instead of decay</source>
        <translation>die Dreieckschwingung anwachsen statt abklingen lassen</translation>
    </message>
    <message>
        <source>make a test motion that stays inside the robot&apos;s limits</source>
        <translation>erzeugt eine Testbewegung innerhalb der Grenzen des Roboters</translation>
    </message>
    <message>
        <source>Write a trajectory that excites axes of a robot. It never leaves the range, voltage, speed and acceleration of an axis; a request beyond them is reduced and reported. A value can be given per axis: --amplitude x=5um,thx=200urad</source>
        <translation>Schreibt eine Trajektorie, die Achsen eines Roboters anregt. Sie verlässt nie Bereich, Spannung, Geschwindigkeit und Beschleunigung einer Achse; was darüber hinaus verlangt ist, wird verringert und gemeldet. Ein Wert kann je Achse angegeben werden: --amplitude x=5um,thx=200urad</translation>
    </message>
    <message>
        <source>axes that move (default: all)</source>
        <translation>Achsen, die sich bewegen (Vorgabe: alle)</translation>
    </message>
    <message>
        <source>rows per second (default: 4 per period of the resonance)</source>
        <translation>Zeilen je Sekunde (Vorgabe: 4 je Periode der Resonanz)</translation>
    </message>
    <message>
        <source>seed of phases and sequences</source>
        <translation>Startwert der Phasen und Folgen</translation>
    </message>
    <message>
        <source>refuse what exceeds a limit instead of reducing it</source>
        <translation>ablehnen, was eine Grenze überschreitet, statt es zu verringern</translation>
    </message>
    <message>
        <source>diagnose the gap between model and machine, predict, correct the model</source>
        <translation>diagnostiziert die Abweichung zwischen Modell und Maschine, sagt voraus, korrigiert das Modell</translation>
    </message>
    <message>
        <source>Diagnose the gap between the model and records of the real machine.</source>
        <translation>Diagnostiziert die Abweichung zwischen dem Modell und Aufzeichnungen der echten Maschine.</translation>
    </message>
    <message>
        <source>write the response of the corrected model to new commands</source>
        <translation>schreibt die Antwort des korrigierten Modells auf neue Sollwerte</translation>
    </message>
    <message>
        <source>Drive the corrected model of a diagnosis with the commands of a trajectory or record, and write the expected record, without noise, rounding and random effects.</source>
        <translation>Führt dem korrigierten Modell einer Diagnose die Sollwerte einer Trajektorie oder Aufzeichnung zu und schreibt die erwartete Aufzeichnung, ohne Rauschen, Rundung und zufällige Effekte.</translation>
    </message>
    <message>
        <source>file of &apos;gap diagnose --json&apos;</source>
        <translation>Datei von &apos;gap diagnose --json&apos;</translation>
    </message>
    <message>
        <source>a trajectory or record</source>
        <translation>eine Trajektorie oder Aufzeichnung</translation>
    </message>
    <message>
        <source>diagnose each case with this command as well, such as &apos;/other/.venv/bin/rotemina&apos;; print where the two answers differ, and the processor time of both</source>
        <translation>jeden Fall auch mit diesem Befehl diagnostizieren, etwa &apos;/other/.venv/bin/rotemina&apos;; ausgeben, wo sich die Antworten unterscheiden und wie viel Prozessorzeit beide brauchen</translation>
    </message>
    <message>
        <source>Say which effects a diagnosis of these records could find at their typical size, which it could not, and which motion would show them. It takes seconds; whether an effect is there is found by &apos;gap diagnose&apos;.</source>
        <translation>Angeben, welche Effekte eine Diagnose dieser Aufzeichnungen in typischer Größe finden könnte, welche nicht, und welche Bewegung sie zeigen würde. Das dauert Sekunden; ob ein Effekt vorhanden ist, findet &apos;gap diagnose&apos; heraus.</translation>
    </message>
    <message>
        <source>write the result as JSON (&apos;-&apos; prints it)</source>
        <translation>das Ergebnis als JSON schreiben (&apos;-&apos; gibt es aus)</translation>
    </message>
    <message>
        <source>say which effects records can show, and which motion would show the others</source>
        <translation>angeben, welche Effekte Aufzeichnungen zeigen können und welche Bewegung die übrigen zeigen würde</translation>
    </message>
    <message>
        <source>file for the record (default: COMMANDS-predicted.csv in this folder)</source>
        <translation>Datei für die Aufzeichnung (Vorgabe: COMMANDS-predicted.csv in diesem Ordner)</translation>
    </message>
    <message>
        <source>the motion before this one; the model starts in the state after that motion</source>
        <translation>die Bewegung davor; das Modell beginnt im Zustand nach dieser Bewegung</translation>
    </message>
    <message>
        <source>seconds between the end of that motion and the first command (default: 0)</source>
        <translation>Sekunden zwischen dem Ende dieser Bewegung und dem ersten Sollwert (Vorgabe: 0)</translation>
    </message>
    <message>
        <source>write a robot file with the fitted effects</source>
        <translation>schreibt eine Roboterdatei mit den angepassten Effekten</translation>
    </message>
    <message>
        <source>Write the diagnosed robot as a robot file for the option --robot of every command. The fitted effects are appended to its own effects.</source>
        <translation>Schreibt den diagnostizierten Roboter als Roboterdatei für die Option --robot aller Befehle. Die angepassten Effekte stehen hinter seinen eigenen.</translation>
    </message>
    <message>
        <source>keep the text of this robot file with its comments; it must be the diagnosed robot (default: the shipped robot if it is the same, else a new text)</source>
        <translation>den Text dieser Roboterdatei samt Kommentaren behalten; sie muss den diagnostizierten Roboter beschreiben (Vorgabe: der mitgelieferte Roboter, wenn es derselbe ist, sonst ein neuer Text)</translation>
    </message>
    <message>
        <source>diagnose machines with known causes, one line each</source>
        <translation>diagnostiziert Maschinen mit bekannten Ursachen, je eine Zeile</translation>
    </message>
    <message>
        <source>Diagnose machines. Each is a folder with robot.toml, records train_*.csv for the diagnosis, records test_*.csv that no fit uses, and its known causes in truth.toml (optional). Print one line each: first cause, sets, how much of the gap closes on the test records, the remaining error and the figure to beat, time, verdict.</source>
        <translation>Diagnostiziert Maschinen. Jede ist ein Ordner mit robot.toml, Aufzeichnungen train_*.csv für die Diagnose, Aufzeichnungen test_*.csv, die keine Anpassung benutzt, und ihren bekannten Ursachen in truth.toml (optional). Gibt je eine Zeile aus: erste Ursache, Mengen, wie viel der Abweichung sich an den Testaufzeichnungen schließt, den Restfehler und den zu unterbietenden Wert, Zeit, Urteil.</translation>
    </message>
    <message>
        <source>folder of a machine, or of several machines</source>
        <translation>Ordner einer Maschine oder mehrerer Maschinen</translation>
    </message>
    <message>
        <source>write the results as JSON (&apos;-&apos; prints them)</source>
        <translation>die Ergebnisse als JSON schreiben (&apos;-&apos; gibt sie aus)</translation>
    </message>
    <message>
        <source>write a page with all results</source>
        <translation>eine Seite mit allen Ergebnissen schreiben</translation>
    </message>
    <message>
        <source>parallel processes of a diagnosis</source>
        <translation>parallele Prozesse einer Diagnose</translation>
    </message>
    <message>
        <source>time limit for each machine, s (default: 1800)</source>
        <translation>Zeitgrenze für jede Maschine, s (Vorgabe: 1800)</translation>
    </message>
    <message>
        <source>run the sealed self-test of the diagnosis and score it</source>
        <translation>führt den versiegelten Selbsttest der Diagnose aus und bewertet ihn</translation>
    </message>
    <message>
        <source>Make cases by equations that the diagnosis does not know, seal their labels, and diagnose each in a process that sees only records; then open the labels and score the answers. A second start continues where the first one ended.</source>
        <translation>Erzeugt Fälle nach Gleichungen, die die Diagnose nicht kennt, versiegelt ihre Lösungen und diagnostiziert jeden in einem Prozess, der nur Aufzeichnungen sieht; danach werden die Lösungen geöffnet und die Antworten bewertet. Ein zweiter Start macht dort weiter, wo der erste endete.</translation>
    </message>
    <message>
        <source>number of cases (default: 300)</source>
        <translation>Anzahl der Fälle (Vorgabe: 300)</translation>
    </message>
    <message>
        <source>seed of the cases (default: 0)</source>
        <translation>Startwert der Fälle (Vorgabe: 0)</translation>
    </message>
    <message>
        <source>equations that make the cases (default: first); each gives its own figures</source>
        <translation>Gleichungen, die die Fälle erzeugen (Vorgabe: first); jede Wahl hat eigene Zahlen</translation>
    </message>
    <message>
        <source>run every N-th case, beginning with the I-th</source>
        <translation>jeden N-ten Fall ab dem I-ten bearbeiten</translation>
    </message>
    <message>
        <source>folder of your own cases</source>
        <translation>Ordner mit eigenen Fällen</translation>
    </message>
    <message>
        <source>their labels, as JSON</source>
        <translation>deren Lösungen, als JSON</translation>
    </message>
    <message>
        <source>folder for the results, one file per case (default: rotemina-blind-SEED in this folder)</source>
        <translation>Ordner für die Ergebnisse, eine Datei je Fall (Vorgabe: rotemina-blind-SEED in diesem Ordner)</translation>
    </message>
    <message>
        <source>write a page, with its picture next to it (seeds from 1000 on)</source>
        <translation>eine Seite schreiben, mit ihrem Bild daneben (Startwerte ab 1000)</translation>
    </message>
    <message>
        <source>write the calibration of probabilities, as JSON (seeds below 1000)</source>
        <translation>die Kalibrierung der Wahrscheinlichkeiten schreiben, als JSON (Startwerte unter 1000)</translation>
    </message>
    <message>
        <source>count the results of this folder as well in the calibration, such as those of the other generator; may be repeated</source>
        <translation>auch die Ergebnisse dieses Ordners in der Kalibrierung zählen, etwa die des anderen Generators; mehrfach möglich</translation>
    </message>
    <message>
        <source>score the finished cases, and diagnose no others</source>
        <translation>die abgeschlossenen Fälle bewerten und keine weiteren diagnostizieren</translation>
    </message>
    <message>
        <source>let three naive methods answer the same cases, for comparison (takes longer)</source>
        <translation>drei naive Verfahren dieselben Fälle beantworten lassen, zum Vergleich (dauert länger)</translation>
    </message>
    <message>
        <source>find where model and machine differ, which effects cause it, and how far the gap shrinks</source>
        <translation>findet, wo Modell und Maschine sich unterscheiden, welche Effekte das bewirken und wie weit die Abweichung schrumpft</translation>
    </message>
    <message>
        <source>Compare the model with records of the real machine, name the effects that the model lacks, and prove this with data that the fit never used. Several records of one robot are diagnosed together; they may differ in rate, length, axes and signals.</source>
        <translation>Vergleicht das Modell mit Aufzeichnungen der echten Maschine, nennt die Effekte, die dem Modell fehlen, und belegt das mit Daten, die die Anpassung nie benutzt hat. Mehrere Aufzeichnungen eines Roboters werden gemeinsam diagnostiziert; sie dürfen sich in Rate, Länge, Achsen und Signalen unterscheiden.</translation>
    </message>
    <message>
        <source>write the diagnosis as JSON, and suggested experiments next to it (&apos;-&apos; prints it)</source>
        <translation>die Diagnose als JSON schreiben, mit vorgeschlagenen Versuchen daneben (&apos;-&apos; gibt sie aus)</translation>
    </message>
    <message>
        <source>write a report, one page that works offline</source>
        <translation>einen Bericht schreiben, eine Seite, die ohne Netz funktioniert</translation>
    </message>
    <message>
        <source>seed of random numbers (default: 0)</source>
        <translation>Startwert der Zufallszahlen (Vorgabe: 0)</translation>
    </message>
    <message>
        <source>Control, simulation and sim-to-real diagnosis of the RoTeMiNa robot. Without a subcommand the operator&apos;s window opens.</source>
        <translation>Steuerung, Simulation und Diagnose der Abweichung zwischen Modell und Wirklichkeit für den Roboter RoTeMiNa. Ohne Unterbefehl öffnet sich das Bedienfenster.</translation>
    </message>
    <message>
        <source>compute the plate that holds the pin by finite elements: stress, stiffness, modes</source>
        <translation>berechnet die Platte, die den Stift hält, mit finiten Elementen: Spannung, Steifigkeit, Moden</translation>
    </message>
    <message>
        <source>Compute the thin plate that holds the pin, as [plate] of the robot file describes it (without that, the shipped plate).</source>
        <translation>Berechnet die dünne Platte, die den Stift hält, wie [plate] der Roboterdatei sie beschreibt (ohne das: die mitgelieferte Platte).</translation>
    </message>
    <message>
        <source>compute stress, reactions, stiffness, friction in the seat, modes, safety against yield</source>
        <translation>berechnet Spannung, Reaktionen, Steifigkeit, Reibung im Sitz, Moden, Sicherheit gegen Fließen</translation>
    </message>
    <message>
        <source>Move the pin&apos;s bottom slowly to a position (by default the upper end of the range of every axis), and print the results.</source>
        <translation>Bewegt das untere Ende des Stifts langsam an eine Position (Vorgabe: oberes Ende des Bereichs jeder Achse) und gibt die Ergebnisse aus.</translation>
    </message>
    <message>
        <source>displacement along the pin, µm</source>
        <translation>Verschiebung entlang des Stifts, µm</translation>
    </message>
    <message>
        <source>sideways displacement divided by the pin&apos;s length, µrad</source>
        <translation>seitliche Verschiebung, geteilt durch die Länge des Stifts, µrad</translation>
    </message>
    <message>
        <source>duration of the motion, s (default: 30)</source>
        <translation>Dauer der Bewegung, s (Vorgabe: 30)</translation>
    </message>
    <message>
        <source>move back to the start as well</source>
        <translation>auch zurück zum Anfang bewegen</translation>
    </message>
    <message>
        <source>number of modes (default: 10)</source>
        <translation>Anzahl der Moden (Vorgabe: 10)</translation>
    </message>
    <message>
        <source>write mesh and fields</source>
        <translation>Netz und Felder schreiben</translation>
    </message>
    <message>
        <source>write the motion as CSV (SI)</source>
        <translation>die Bewegung als CSV (SI) schreiben</translation>
    </message>
    <message>
        <source>write a robot file with the plate&apos;s stiffness, mass and couplings</source>
        <translation>schreibt eine Roboterdatei mit Steifigkeit, Masse und Kopplungen der Platte</translation>
    </message>
    <message>
        <source>Turn the plate into entries of a robot file, and print how far they differ from its present ones. Damping is not changed.</source>
        <translation>Wandelt die Platte in Einträge einer Roboterdatei um und gibt aus, wie weit sie von den vorhandenen abweichen. Die Dämpfung bleibt unverändert.</translation>
    </message>
    <message>
        <source>elements around the circumference (default: %(default)s)</source>
        <translation>Elemente um den Umfang (Vorgabe: %(default)s)</translation>
    </message>
    <message>
        <source>play a trajectory on the simulator and write the record</source>
        <translation>spielt eine Trajektorie am Simulator ab und schreibt die Aufzeichnung</translation>
    </message>
    <message>
        <source>Check a trajectory against the robot&apos;s limits, play it on the simulator as fast as possible, and write the record.</source>
        <translation>Prüft eine Trajektorie gegen die Grenzen des Roboters, spielt sie am Simulator so schnell wie möglich ab und schreibt die Aufzeichnung.</translation>
    </message>
    <message>
        <source>file for the record (default: TRAJECTORY-record.csv in this folder)</source>
        <translation>Datei für die Aufzeichnung (Vorgabe: TRAJECTORY-record.csv in diesem Ordner)</translation>
    </message>
    <message>
        <source>convert every set-point with the recommended inverse of this file</source>
        <translation>jeden Sollwert mit der empfohlenen Inversen dieser Datei umwandeln</translation>
    </message>
    <message>
        <source>control the axis with the loop chosen in this file of &apos;rotemina tune&apos;; --compensate, if given, becomes its feed-forward</source>
        <translation>die Achse mit dem Regelkreis regeln, der in dieser Datei von &apos;rotemina tune&apos; gewählt ist; --compensate, falls angegeben, wird seine Vorsteuerung</translation>
    </message>
    <message>
        <source>seed of the sensor noise (default: 0)</source>
        <translation>Startwert des Sensorrauschens (Vorgabe: 0)</translation>
    </message>
    <message>
        <source>only check the trajectory against the limits</source>
        <translation>die Trajektorie nur gegen die Grenzen prüfen</translation>
    </message>
    <message>
        <source>write a new plugin, list plugins and check them</source>
        <translation>schreibt ein neues Plugin, listet Plugins auf und prüft sie</translation>
    </message>
    <message>
        <source>Plugins of all kinds: drivers, panels, effects, cameras, input devices.</source>
        <translation>Plugins aller Arten: Treiber, Panels, Effekte, Kameras, Eingabegeräte.</translation>
    </message>
    <message>
        <source>write a package with a working, tested plugin</source>
        <translation>schreibt ein Paket mit einem lauffähigen, getesteten Plugin</translation>
    </message>
    <message>
        <source>Write a package into a new folder rotemina-NAME. Existing files are not overwritten.</source>
        <translation>Schreibt ein Paket in einen neuen Ordner rotemina-NAME. Vorhandene Dateien werden nicht überschrieben.</translation>
    </message>
    <message>
        <source>small letters, digits, single underscores</source>
        <translation>Kleinbuchstaben, Ziffern, einzelne Unterstriche</translation>
    </message>
    <message>
        <source>parent folder (default: here)</source>
        <translation>übergeordneter Ordner (Vorgabe: dieser)</translation>
    </message>
    <message>
        <source>print one line for each plugin, and why a plugin was not loaded</source>
        <translation>gibt eine Zeile je Plugin aus, und warum ein Plugin nicht geladen wurde</translation>
    </message>
    <message>
        <source>only this kind</source>
        <translation>nur diese Art</translation>
    </message>
    <message>
        <source>run the checks for the plugin&apos;s kind</source>
        <translation>führt die Prüfungen für die Art des Plugins aus</translation>
    </message>
    <message>
        <source>Import a plugin again and run the checks of its kind. For the driver of a real device, no check moves an axis (see `rotemina driver check`). Exit status: 0 all passed, 1 a check failed.</source>
        <translation>Importiert ein Plugin neu und führt die Prüfungen seiner Art aus. Beim Treiber eines echten Geräts bewegt keine Prüfung eine Achse (siehe `rotemina driver check`). Rückgabewert: 0 alle bestanden, 1 eine nicht bestanden.</translation>
    </message>
    <message>
        <source>kind, if plugins of several kinds have this name</source>
        <translation>Art, wenn Plugins mehrerer Arten diesen Namen haben</translation>
    </message>
    <message>
        <source>inspect recordings of sessions, recover and export them</source>
        <translation>zeigt Aufnahmen von Sitzungen, stellt sie wieder her und exportiert sie</translation>
    </message>
    <message>
        <source>Inspect recordings of sessions, recover them after a crash, and export parts of them as records or as trajectories that can be played.</source>
        <translation>Zeigt Aufnahmen von Sitzungen, stellt sie nach einem Absturz wieder her und exportiert Abschnitte als Aufzeichnungen oder als abspielbare Trajektorien.</translation>
    </message>
    <message>
        <source>print the contents of a recording</source>
        <translation>zeigt den Inhalt einer Aufnahme</translation>
    </message>
    <message>
        <source>list the events as well</source>
        <translation>auch die Ereignisse auflisten</translation>
    </message>
    <message>
        <source>print only the robot file of the recording</source>
        <translation>nur die Roboterdatei der Aufnahme ausgeben</translation>
    </message>
    <message>
        <source>complete recordings after a crash</source>
        <translation>vervollständigt Aufnahmen nach einem Absturz</translation>
    </message>
    <message>
        <source>write a part as a record, or as a trajectory</source>
        <translation>schreibt einen Abschnitt als Aufzeichnung oder als Trajektorie</translation>
    </message>
    <message>
        <source>start of the part, in seconds from the start of the recording</source>
        <translation>Anfang des Abschnitts, in Sekunden ab Beginn der Aufnahme</translation>
    </message>
    <message>
        <source>end of the part, in seconds from the start of the recording</source>
        <translation>Ende des Abschnitts, in Sekunden ab Beginn der Aufnahme</translation>
    </message>
    <message>
        <source>write the commands of the axes that moved as a checked trajectory</source>
        <translation>die Sollwerte der bewegten Achsen als geprüfte Trajektorie schreiben</translation>
    </message>
    <message>
        <source>period of the trajectory&apos;s rows (default: %(default)g s)</source>
        <translation>Periode der Zeilen der Trajektorie (Vorgabe: %(default)g s)</translation>
    </message>
    <message>
        <source>write a record in which the position of this axis (x, y, thx, thy) in the microscope&apos;s picture is the reference, for &apos;rotemina gap diagnose&apos;</source>
        <translation>eine Aufzeichnung schreiben, deren Referenz die Position dieser Achse (x, y, thx, thy) im Bild des Mikroskops ist, für &apos;rotemina gap diagnose&apos;</translation>
    </message>
    <message>
        <source>simulate the robot with its effects for the commands of a file</source>
        <translation>simuliert den Roboter mit seinen Effekten für die Sollwerte einer Datei</translation>
    </message>
    <message>
        <source>Drive the model, with the effects and the noise of its robot file, with the commands of a trajectory or record, and write what the machine would record: cmd, u, ref and meas. Memory use does not grow with the length of the file.</source>
        <translation>Führt dem Modell, mit den Effekten und dem Rauschen seiner Roboterdatei, die Sollwerte einer Trajektorie oder Aufzeichnung zu und schreibt, was die Maschine aufzeichnen würde: cmd, u, ref und meas. Der Speicherbedarf wächst nicht mit der Länge der Datei.</translation>
    </message>
    <message>
        <source>use the effects of this robot file instead of those of --robot</source>
        <translation>die Effekte dieser Roboterdatei statt derer von --robot nehmen</translation>
    </message>
    <message>
        <source>seed of noise and random effects (default: 0)</source>
        <translation>Startwert von Rauschen und zufälligen Effekten (Vorgabe: 0)</translation>
    </message>
    <message>
        <source>no noise, no rounding, no random effects</source>
        <translation>kein Rauschen, keine Rundung, keine zufälligen Effekte</translation>
    </message>
    <message>
        <source>write accelerations and joint forces as CSV</source>
        <translation>Beschleunigungen und Gelenkkräfte als CSV schreiben</translation>
    </message>
    <message>
        <source>serve an emulated G-code stage, to try out the driver gcode</source>
        <translation>stellt einen emulierten G-Code-Tisch bereit, um den Treiber gcode zu erproben</translation>
    </message>
    <message>
        <source>Emulate a GRBL controller that drives the axes of a robot, on a pseudo-terminal. The robot file defines its settings, and must contain only stepper axes. Commands on standard input, one per line: limit (a limit switch closes), power (the supply fails and returns), door (the safety door opens), closed (the door closes).</source>
        <translation>Emuliert an einem Pseudoterminal eine GRBL-Steuerung, die die Achsen eines Roboters antreibt. Die Roboterdatei bestimmt ihre Einstellungen und darf nur Schrittmotorachsen enthalten. Befehle auf der Standardeingabe, einer je Zeile: limit (ein Endschalter schließt), power (die Versorgung fällt aus und kehrt zurück), door (die Schutztür öffnet), closed (die Tür schließt).</translation>
    </message>
    <message>
        <source>maximum speed of an axis, or of all axes with this unit; needed for axes whose speed the robot file does not limit</source>
        <translation>Höchstgeschwindigkeit einer Achse oder aller Achsen dieser Einheit; nötig für Achsen, deren Geschwindigkeit die Roboterdatei nicht begrenzt</translation>
    </message>
    <message>
        <source>home all axes together, as plain GRBL does</source>
        <translation>alle Achsen gemeinsam referenzieren, wie GRBL ohne Zusätze</translation>
    </message>
    <message>
        <source>find gains for a position loop with the simulated axis</source>
        <translation>findet die Verstärkungen eines Lageregelkreises an der simulierten Achse</translation>
    </message>
    <message>
        <source>Search for the gains of a PI or PID loop with a notch and a low-pass filter for one axis. NSGA-II simulates the loop with the effects and the noise of the robot file. It minimizes the tracking error and, as second objective, the control effort or the settling time. The peak sensitivity stays bounded even if the gain and the resonance of the axis differ by 5 %. Ctrl-C ends the search and keeps the points found so far.</source>
        <translation>Sucht die Verstärkungen eines PI- oder PID-Kreises mit Kerbfilter und Tiefpass für eine Achse. NSGA-II simuliert den Kreis mit den Effekten und dem Rauschen der Roboterdatei. Minimiert werden der Folgefehler und, als zweites Ziel, der Stellaufwand oder die Einschwingzeit. Die maximale Empfindlichkeit bleibt beschränkt, auch wenn Verstärkung und Resonanz der Achse um 5 % abweichen. Strg-C beendet die Suche und behält die bisher gefundenen Punkte.</translation>
    </message>
    <message>
        <source>TOML file for the result; with --choose, the file to change</source>
        <translation>TOML-Datei für das Ergebnis; mit --choose die Datei, die geändert wird</translation>
    </message>
    <message>
        <source>axis to be tuned</source>
        <translation>Achse, die abgestimmt wird</translation>
    </message>
    <message>
        <source>use the recommended inverse of this file as feed-forward</source>
        <translation>die empfohlene Inverse dieser Datei als Vorsteuerung benutzen</translation>
    </message>
    <message>
        <source>rate of the loop (default: 5000)</source>
        <translation>Rate des Regelkreises (Vorgabe: 5000)</translation>
    </message>
    <message>
        <source>delay of the outputs, in sampling periods</source>
        <translation>Verzögerung der Ausgänge, in Abtastperioden</translation>
    </message>
    <message>
        <source>second objective in addition to the tracking error (default: effort)</source>
        <translation>zweites Ziel neben dem Folgefehler (Vorgabe: effort)</translation>
    </message>
    <message>
        <source>number of cores (default: all)</source>
        <translation>Anzahl der Kerne (Vorgabe: alle)</translation>
    </message>
    <message>
        <source>also write the result as JSON (&apos;-&apos; prints it)</source>
        <translation>das Ergebnis auch als JSON schreiben (&apos;-&apos; gibt es aus)</translation>
    </message>
    <message>
        <source>do not search: choose point N of the existing result</source>
        <translation>nicht suchen: Punkt N des vorhandenen Ergebnisses wählen</translation>
    </message>
    <message>
        <source>default: %(default)s</source>
        <translation>Vorgabe: %(default)s</translation>
    </message>
    <message>
        <source>driver of the machine (default: simulator)</source>
        <translation>Treiber der Maschine (Vorgabe: simulator)</translation>
    </message>
    <message>
        <source>a setting of the driver, such as port=/dev/ttyUSB0 (may be repeated; default: last used in the window)</source>
        <translation>eine Einstellung des Treibers, etwa port=/dev/ttyUSB0 (mehrfach möglich; Vorgabe: die zuletzt im Fenster benutzte)</translation>
    </message>
    <message>
        <source>run without a display: play the example trajectory on the simulator, compare model and machine, and write picture and report into a folder</source>
        <translation>ohne Anzeige laufen: die Beispieltrajektorie am Simulator abspielen, Modell und Maschine vergleichen, Bild und Bericht in einen Ordner schreiben</translation>
    </message>
    <message>
        <source>folder for the picture and the report of a run without a display (default: rotemina-run)</source>
        <translation>Ordner für Bild und Bericht eines Laufs ohne Anzeige (Vorgabe: rotemina-run)</translation>
    </message>
    <message>
        <source>language of window, help and messages (default: last used in the window, else the system&apos;s)</source>
        <translation>Sprache von Fenster, Hilfe und Meldungen (Vorgabe: zuletzt im Fenster benutzte, sonst die des Systems)</translation>
    </message>
    <message>
        <source>processes that work at once (default: one per usable core)</source>
        <translation>Prozesse, die gleichzeitig arbeiten (Vorgabe: einer je nutzbarem Kern)</translation>
    </message>
    <message>
        <source>use a Dask cluster, such as tcp://host:8786 (needs the extra &apos;dask&apos;)</source>
        <translation>einen Dask-Cluster benutzen, etwa tcp://host:8786 (braucht das Extra &apos;dask&apos;)</translation>
    </message>
    <message>
        <source>name the columns of a file without a header, e.g. &apos;t [s], x [mm], thx [urad]&apos;</source>
        <translation>Spalten einer Datei ohne Kopfzeile benennen, z. B. &apos;t [s], x [mm], thx [urad]&apos;</translation>
    </message>
    <message>
        <source>usage: </source>
        <translation>Aufruf: </translation>
    </message>
    <message>
        <source>argument %(argument_name)s: %(message)s</source>
        <translation>Argument %(argument_name)s: %(message)s</translation>
    </message>
    <message>
        <source>positional arguments</source>
        <translation>Argumente</translation>
    </message>
    <message>
        <source>options</source>
        <translation>Optionen</translation>
    </message>
    <message>
        <source>subcommands</source>
        <translation>Unterbefehle</translation>
    </message>
    <message>
        <source>show this help message and exit</source>
        <translation>diese Hilfe zeigen und enden</translation>
    </message>
    <message>
        <source>show program&apos;s version number and exit</source>
        <translation>die Version des Programms zeigen und enden</translation>
    </message>
    <message>
        <source>unrecognized arguments: %s</source>
        <translation>unbekannte Argumente: %s</translation>
    </message>
    <message>
        <source>not allowed with argument %s</source>
        <translation>nicht zusammen mit Argument %s erlaubt</translation>
    </message>
    <message>
        <source>ignored explicit argument %r</source>
        <translation>nimmt keinen Wert, hat aber %r</translation>
    </message>
    <message>
        <source>the following arguments are required: %s</source>
        <translation>diese Argumente fehlen: %s</translation>
    </message>
    <message>
        <source>one of the arguments %s is required</source>
        <translation>eines der Argumente %s fehlt</translation>
    </message>
    <message>
        <source>expected one argument</source>
        <translation>genau ein Wert erwartet</translation>
    </message>
    <message>
        <source>expected at most one argument</source>
        <translation>höchstens ein Wert erwartet</translation>
    </message>
    <message>
        <source>expected at least one argument</source>
        <translation>mindestens ein Wert erwartet</translation>
    </message>
    <message>
        <source>expected %s argument</source>
        <translation>%s Wert erwartet</translation>
    </message>
    <message>
        <source>expected %s arguments</source>
        <translation>%s Werte erwartet</translation>
    </message>
    <message>
        <source>ambiguous option: %(option)s could match %(matches)s</source>
        <translation>mehrdeutige Option: %(option)s kann %(matches)s bedeuten</translation>
    </message>
    <message>
        <source>invalid %(type)s value: %(value)r</source>
        <translation>ungültiger Wert, kein %(type)s: %(value)r</translation>
    </message>
    <message>
        <source>invalid choice: %(value)r (choose from %(choices)s)</source>
        <translation>ungültige Wahl: %(value)r (möglich: %(choices)s)</translation>
    </message>
    <message>
        <source>unknown parser %(parser_name)r (choices: %(choices)s)</source>
        <translation>unbekannter Unterbefehl %(parser_name)r (möglich: %(choices)s)</translation>
    </message>
    <message>
        <source>%(prog)s: error: %(message)s
</source>
        <translation>%(prog)s: Fehler: %(message)s
</translation>
    </message>
    <message>
        <source>a robot file, or a shipped robot: emps, fsm, picma, rotemina, rotemina_worn, xyz (default: rotemina)</source>
        <translation>eine Roboterdatei oder ein mitgelieferter Roboter: emps, fsm, picma, rotemina, rotemina_worn, xyz (Vorgabe: rotemina)</translation>
    </message>
    <message>
        <source>open it in the browser</source>
        <translation>im Browser öffnen</translation>
    </message>
    <message>
        <source>write the run report of a recording or a playback</source>
        <translation>den Laufbericht einer Aufnahme oder Wiedergabe schreiben</translation>
    </message>
    <message>
        <source>*.arrows, or a text record</source>
        <translation>*.arrows oder eine Aufzeichnung als Text</translation>
    </message>
</context>
</TS>
