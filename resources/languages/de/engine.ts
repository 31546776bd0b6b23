<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>engine</name>
    <message>
        <source>another device is connected</source>
        <extracomment>Corrects readings before anything else uses them. The driver that is or was last open; replaced only on the thread of this worker. Deviation of readings from commands, which checks of the tip take into account. Inverses that the host applies, because the device cannot. Executor for the current driver. Any thread may read its targets and speeds. Whether another worker has replaced this one, because it hangs in its driver. Whether the worker has ended and released its driver.</extracomment>
        <translation>ein anderes Gerät ist verbunden</translation>
    </message>
    <message>
        <source>the machine is still moving; change the model at rest</source>
        <translation>die Maschine bewegt sich noch; das Modell in Ruhe wechseln</translation>
    </message>
    <message>
        <source>the model belongs to another machine: {why}; diagnose this one</source>
        <translation>das Modell gehört nicht zu dieser Maschine: {why}; diese hier diagnostizieren</translation>
    </message>
    <message>
        <source>{stop} is still active with {name}; release it to move</source>
        <translation>{stop} ist auch mit {name} noch aktiv; zum Bewegen freigeben</translation>
    </message>
    <message>
        <source>connecting; wait</source>
        <translation>wird verbunden; warten</translation>
    </message>
    <message>
        <source>stopped: {lock}</source>
        <translation>angehalten: {lock}</translation>
    </message>
    <message>
        <source>the device reports a fault</source>
        <translation>das Gerät meldet einen Fehler</translation>
    </message>
    <message>
        <source>unexpected {name} from the driver: {error}</source>
        <translation>unerwarteter Fehler vom Treiber: {name}: {error}</translation>
    </message>
    <message>
        <source>axis {axis} reads {much} beyond its range</source>
        <translation>Achse {axis} misst {much} außerhalb ihres Bereichs</translation>
    </message>
    <message>
        <source>axis {axis} reads {much} beyond its range; at most {most} is permitted</source>
        <translation>Achse {axis} misst {much} außerhalb ihres Bereichs; zulässig sind höchstens {most}</translation>
    </message>
    <message>
        <source>axis {axis} reads {much} away from its command; at most {most} is permitted</source>
        <translation>Achse {axis} misst {much} Abstand zum Sollwert; zulässig sind höchstens {most}</translation>
    </message>
    <message>
        <source>the session has already been started; create a new one</source>
        <translation>die Sitzung wurde schon gestartet; eine neue anlegen</translation>
    </message>
    <message>
        <source>the device is being connected; wait</source>
        <translation>das Gerät wird verbunden; bitte warten</translation>
    </message>
    <message>
        <source>the device is connected</source>
        <translation>das Gerät ist verbunden</translation>
    </message>
    <message>
        <source>{name} still hangs in an earlier call; choose Connect on the panel Connection to open it again, or choose another device</source>
        <translation>{name} hängt noch in einem früheren Aufruf; wählen Sie im Fenster Verbindung Verbinden, um das Gerät neu zu öffnen, oder wählen Sie ein anderes Gerät</translation>
    </message>
    <message>
        <source>the device is being released</source>
        <extracomment>Heartbeat of the thread that shows the session to an operator. Once it has begun to beat, motion stops if the beats cease. Heartbeat of the worker.</extracomment>
        <translation>das Gerät wird getrennt</translation>
    </message>
    <message>
        <source>driver {name} is for a robot with axes {axes}; this one has {these}; start the program with that robot</source>
        <translation>Treiber {name} gehört zu einem Roboter mit den Achsen {axes}; dieser hat {these}; das Programm mit dem passenden Roboter starten</translation>
    </message>
    <message>
        <source>another device is being connected</source>
        <translation>ein anderes Gerät wird verbunden</translation>
    </message>
    <message>
        <source>the window does not respond</source>
        <translation>das Fenster reagiert nicht</translation>
    </message>
    <message>
        <source>this program did not run for {paused} s (computer asleep or overloaded); check the machine, then move again</source>
        <translation>dieses Programm lief {paused} s lang nicht (Rechner im Ruhezustand oder überlastet); prüfen Sie die Maschine, und fahren Sie dann weiter</translation>
    </message>
    <message>
        <source>another device is being connected; wait</source>
        <translation>ein anderes Gerät wird verbunden; bitte warten</translation>
    </message>
    <message>
        <source>{name} has not answered for {seconds} s and could not be disconnected: the program no longer uses it. If its machine moves, use its emergency stop switch; check cable and device</source>
        <extracomment>Why all motion is refused, or None while it is permitted. Host time of the latest stop, by any requester; None before the first.</extracomment>
        <translation>{name} hat seit {seconds} s nicht geantwortet und ließ sich nicht trennen: Das Programm verwendet das Gerät nicht mehr. Falls sich seine Maschine bewegt, benutzen Sie ihren Not-Halt; prüfen Sie Kabel und Gerät</translation>
    </message>
    <message>
        <source>not connected</source>
        <translation>nicht verbunden</translation>
    </message>
    <message>
        <source>an axis is driven by {other}</source>
        <translation>eine Achse wird von {other} bewegt</translation>
    </message>
    <message>
        <source>the device has sent nothing for {seconds} s; wait, or reconnect</source>
        <translation>das Gerät hat seit {seconds} s nichts gesendet; warten oder wieder verbinden</translation>
    </message>
    <message>
        <source>not connected; connect first</source>
        <translation>nicht verbunden; erst verbinden</translation>
    </message>
    <message>
        <source>a penetration is in phase {phase}; end it first</source>
        <translation>eine Penetration ist in der Phase {phase}; beenden Sie sie zuerst</translation>
    </message>
    <message>
        <source>a penetration is in phase {phase}; stop it first</source>
        <translation>eine Penetration ist in der Phase {phase}; halten Sie sie zuerst an</translation>
    </message>
    <message>
        <source>the program released it</source>
        <translation>das Programm hat sie freigegeben</translation>
    </message>
    <message>
        <source>the penetration is not armed; arm it first</source>
        <translation>die Penetration ist nicht scharf; erst scharfstellen</translation>
    </message>
    <message>
        <source>the retraction was stopped by the button</source>
        <translation>der Rückzug wurde per Taste angehalten</translation>
    </message>
    <message>
        <source>stopped by the button in {phase}</source>
        <translation>per Taste angehalten, Phase {phase}</translation>
    </message>
    <message>
        <source>it was not started in time</source>
        <extracomment>The current status. It is replaced as a whole, so it can be read without the lock.</extracomment>
        <translation>nicht rechtzeitig gestartet</translation>
    </message>
    <message>
        <source>the penetration cannot start: {broken}</source>
        <translation>die Penetration kann nicht beginnen: {broken}</translation>
    </message>
    <message>
        <source>the axis has moved since it was armed; arm it again</source>
        <translation>die Achse hat sich seit dem Scharfstellen bewegt; erneut scharfstellen</translation>
    </message>
    <message>
        <source>the penetration no longer owns the axes; move them manually</source>
        <translation>die Achsen gehören nicht mehr zur Penetration; von Hand bewegen</translation>
    </message>
    <message>
        <source>retracted by the button; before: {reason}</source>
        <translation>per Taste zurückgezogen; zuvor: {reason}</translation>
    </message>
    <message>
        <source>axis {axis}: the run needs {needed}, but the whole range is {range}; shorten approach_distance or depth</source>
        <translation>Achse {axis}: der Lauf braucht {needed}, der ganze Bereich ist {range}; approach_distance oder depth verkürzen</translation>
    </message>
    <message>
        <source>driver {driver} cannot move at a set speed, which the approach needs</source>
        <translation>Treiber {driver} kann nicht mit vorgegebener Geschwindigkeit fahren, wie es die Anfahrt verlangt</translation>
    </message>
    <message>
        <source>driver {driver} has no tool for injection; set inject_s to 0</source>
        <translation>Treiber {driver} hat kein Werkzeug zum Injizieren; Injektion auf 0 setzen</translation>
    </message>
    <message>
        <source>robot {name} has no axis {axis} to penetrate with; it has {axes}</source>
        <translation>Roboter {name} hat keine Achse {axis} für die Penetration; er hat {axes}</translation>
    </message>
    <message>
        <source>approach_speed = {approach_speed}: axis {name} moves at {max_speed} at most</source>
        <translation>approach_speed = {approach_speed}: Achse {name} fährt höchstens {max_speed}</translation>
    </message>
    <message>
        <source>axis {axis} has {left} of travel left {direction}wards, but the run needs {needed} ({approach} to approach, {halt} to halt, {thrust} to thrust); move the axis back first, or shorten them</source>
        <translation>Achse {axis}: {direction} sind {left} frei, {needed} nötig ({approach} Anfahrt, {halt} Anhalten, {thrust} Einstich); die Achse zurückfahren oder kürzen</translation>
    </message>
    <message>
        <source>the device sends too few samples</source>
        <translation>das Gerät sendet zu wenige Messwerte</translation>
    </message>
    <message>
        <source>no contact within {distance}; start nearer to the cell</source>
        <translation>kein Kontakt auf {distance}; näher an der Zelle beginnen</translation>
    </message>
    <message>
        <source>the axis did not come to rest</source>
        <translation>die Achse kam nicht zur Ruhe</translation>
    </message>
    <message>
        <source>the device did not run the thrust</source>
        <translation>das Gerät führte den Einstich nicht aus</translation>
    </message>
    <message>
        <source>too few samples of the thrust</source>
        <translation>zu wenige Messwerte vom Einstich</translation>
    </message>
    <message>
        <source>the thrust reached {depth} instead of {asked}, more than {tolerance} % off</source>
        <translation>der Einstich erreichte {depth} statt {asked}, mehr als {tolerance} % Abweichung</translation>
    </message>
    <message>
        <source>the axis did not return</source>
        <translation>die Achse kam nicht zurück</translation>
    </message>
    <message>
        <source>overload: the axis is {load} from its command; at most {most} is permitted</source>
        <translation>Überlast: die Achse ist {load} von ihrem Sollwert entfernt; zulässig sind höchstens {most}</translation>
    </message>
    <message>
        <source>a stop was requested</source>
        <translation>ein Halt wurde verlangt</translation>
    </message>
    <message>
        <source>another control took over an axis</source>
        <translation>eine andere Steuerung hat eine Achse übernommen</translation>
    </message>
    <message>
        <source>shaping = {shaping}: axis {axis} of {robot} has no resonance in its robot file; choose &apos;none&apos;</source>
        <translation>Impulsformung {shaping}: Achse {axis} von {robot} hat keine Resonanz in der Roboterdatei; „keine“ wählen</translation>
    </message>
    <message>
        <source>duration_s = {duration} s: input shaping {shaping} takes {taken} s of it; use at least {least} s, or another shaping</source>
        <translation>Dauer {duration} s: die Impulsformung {shaping} braucht davon {taken} s; mindestens {least} s oder eine andere Impulsformung</translation>
    </message>
    <message>
        <source>thrust: no sample was taken after it (samples: {count})</source>
        <translation>Einstich: kein Abtastwert liegt danach (Abtastwerte: {count})</translation>
    </message>
    <message>
        <source>thrust: no sample was taken before it (samples: {count})</source>
        <translation>Einstich: kein Abtastwert liegt davor (Abtastwerte: {count})</translation>
    </message>
    <message>
        <source>{capacity} commands are already waiting because the device does not keep up; wait, or stop</source>
        <translation>{capacity} Befehle warten schon, das Gerät kommt nicht nach; warten oder anhalten</translation>
    </message>
    <message>
        <source>{path}: the positions belong to robot {robot}, not to {name}; move the file away</source>
        <translation>{path}: die Positionen gehören zu Roboter {robot}, nicht zu {name}; die Datei verschieben</translation>
    </message>
    <message>
        <source>{most} positions, the maximum, are saved; delete some</source>
        <translation>es sind schon {most} Positionen gespeichert, mehr sind nicht möglich; einige löschen</translation>
    </message>
    <message>
        <source>there is no position {name}</source>
        <translation>es gibt keine Position {name}</translation>
    </message>
    <message>
        <source>axis {missing} is missing</source>
        <extracomment>Names of positions with their own buttons.</extracomment>
        <translation>Achse {missing} fehlt</translation>
    </message>
    <message>
        <source>there is no axis {other}</source>
        <translation>es gibt keine Achse {other}</translation>
    </message>
    <message>
        <source>{where}position {name}: {what}; it needs {axes}</source>
        <translation>{where}Position {name}: {what}; sie braucht {axes}</translation>
    </message>
    <message>
        <source>{where}position {name}: {error}</source>
        <translation>{where}Position {name}: {error}</translation>
    </message>
    <message>
        <source>playback: the speed {speed} must be {slowest} to {fastest} times that of the trajectory</source>
        <translation>Wiedergabe: Tempo {speed}: muss das {slowest}- bis {fastest}-Fache der Trajektorie sein</translation>
    </message>
    <message>
        <source>playback: row {row}: the trajectory has rows 0 to {rows}</source>
        <translation>Wiedergabe: Zeile {row}: die Trajektorie hat die Zeilen 0 bis {rows}</translation>
    </message>
    <message>
        <source>{names} moved together; move only one</source>
        <translation>{names} zugleich bewegt; nur eines bewegen</translation>
    </message>
    <message>
        <source>move the {what} now</source>
        <translation>jetzt bewegen: {what}</translation>
    </message>
    <message>
        <source>{kind} {control} of {device}</source>
        <translation>{kind} {control} von {device}</translation>
    </message>
    <message>
        <source>another profile is now in use</source>
        <extracomment>Checked readings of the latest step by device key, oldest first. Whether only stops are passed on, because devices are being set up.</extracomment>
        <translation>jetzt wird ein anderes Profil verwendet</translation>
    </message>
    <message>
        <source>device {key} is not plugged in, so no calibration can be applied</source>
        <translation>Gerät {key} ist nicht angesteckt; eine Kalibrierung lässt sich nicht anwenden</translation>
    </message>
    <message>
        <source>this calibration is for {device}, not for {key}</source>
        <translation>diese Kalibrierung ist für {device}, nicht für {key}</translation>
    </message>
    <message>
        <source>recalibrated</source>
        <translation>neu kalibriert</translation>
    </message>
    <message>
        <source>input devices are being set up</source>
        <translation>Eingabegeräte werden eingerichtet</translation>
    </message>
    <message>
        <source>no profile is chosen: the input devices do nothing</source>
        <translation>kein Profil gewählt: die Eingabegeräte tun nichts</translation>
    </message>
    <message>
        <source>the program was suspended or overloaded: its clock jumped by {pause} s. Release the device and start again</source>
        <translation>das Programm war angehalten oder überlastet: seine Uhr sprang um {pause} s. Das Gerät loslassen und neu beginnen</translation>
    </message>
    <message>
        <source>another device was lost ({why}): release it</source>
        <translation>ein anderes Gerät ist ausgefallen ({why}): loslassen</translation>
    </message>
    <message>
        <source>the machine is being stopped</source>
        <translation>die Maschine wird angehalten</translation>
    </message>
    <message>
        <source>there is no mode {name}; use {names}</source>
        <translation>den Modus {name} gibt es nicht; möglich: {names}</translation>
    </message>
    <message>
        <source>the scales were changed</source>
        <extracomment>Motion of the coordinates for full deflection of a stick.</extracomment>
        <translation>die Maßstäbe wurden geändert</translation>
    </message>
    <message>
        <source>the joystick&apos;s stop and lock</source>
        <translation>Halt und sperren am Joystick</translation>
    </message>
    <message>
        <source>the joystick&apos;s stop</source>
        <translation>Halt am Joystick</translation>
    </message>
    <message>
        <source>the machine is {activity}</source>
        <translation>Maschine: {activity}</translation>
    </message>
    <message>
        <source>driver {driver} cannot move at a set speed</source>
        <translation>Treiber {driver} kann nicht mit vorgegebener Geschwindigkeit fahren</translation>
    </message>
    <message>
        <source>no stick is active: release it, and hold its dead-man button if it has one</source>
        <translation>kein verlässlicher Joystick: loslassen; Zustimmtaster halten, falls vorhanden</translation>
    </message>
    <message>
        <source>axes are moved by {owner}</source>
        <translation>Achsen werden bewegt durch: {owner}</translation>
    </message>
    <message>
        <source>axis {axis} does not follow the stick</source>
        <translation>Achse {axis} folgt dem Joystick nicht</translation>
    </message>
    <message>
        <source>slowed: the tip is close to its bounds</source>
        <translation>verlangsamt: die Spitze ist nahe an ihren Grenzen</translation>
    </message>
    <message>
        <source>a reading has {axes} axes and {buttons} buttons, but the device has {known} and {others}: replug it</source>
        <extracomment>Longest permitted silence of a device that reports only changes, while it moves an axis. Longest permitted time between two steps that read the devices. After a longer pause, changes may have been missed.</extracomment>
        <translation>eine Meldung hat {axes} Achsen und {buttons} Tasten, das Gerät aber {known} und {others}: neu anstecken</translation>
    </message>
    <message>
        <source>its plugin ({source}) returned {answer}, which is no reading, and the device counts as released. Update or remove the plugin</source>
        <translation>sein Plugin ({source}) lieferte {answer}, das ist keine Meldung; das Gerät gilt als losgelassen. Das Plugin aktualisieren oder entfernen</translation>
    </message>
    <message>
        <source>the trainer&apos;s device is not connected: the trainee cannot drive alone</source>
        <translation>das Gerät des Trainers ist nicht angeschlossen: der Trainee kann nicht allein steuern</translation>
    </message>
    <message>
        <source>the trainer has taken over</source>
        <translation>der Trainer hat übernommen</translation>
    </message>
    <message>
        <source>the trainee has taken over</source>
        <translation>der Trainee hat übernommen</translation>
    </message>
    <message>
        <source>profile {name}: robot axis {axis} would have two owners, {owner} and {other_owner}; let one of them drive something else</source>
        <translation>Profil {name}: Roboterachse {axis} hätte zwei Besitzer, {owner} und {other_owner}; einen davon etwas anderes bewegen lassen</translation>
    </message>
    <message>
        <source>profile {name}: every device has seat = &apos;trainee&apos;; one must have &apos;trainer&apos;</source>
        <translation>Profil {name}: jedes Gerät hat seat = &apos;trainee&apos;; eines muss &apos;trainer&apos; haben</translation>
    </message>
    <message>
        <source>nothing</source>
        <extracomment>Degrees of freedom of the stick, and the robot&apos;s axes that each can move, depending on the mode. The tilt thy moves the tip of a pin along x, and the tilt thx along y.</extracomment>
        <translation>nichts</translation>
    </message>
    <message>
        <source>an axis needs at = …</source>
        <translation>eine Achse braucht at = …</translation>
    </message>
    <message>
        <source>{control} of {key} (drives {drives})</source>
        <translation>{control} von {key} (bewegt {drives})</translation>
    </message>
    <message>
        <source>profile {name}: {control} drives {drives}, which the robot does not have; known: {names}</source>
        <translation>Profil {name}: {control} bewegt {drives}, das der Roboter nicht hat; bekannt: {names}</translation>
    </message>
    <message>
        <source>drives {drives}</source>
        <translation>bewegt {drives}</translation>
    </message>
    <message>
        <source>profile {name}: control {control} of {key} would have two functions, {found} and {use}; remove one</source>
        <translation>Profil {name}: Bedienelement {control} von {key} hätte zwei Funktionen, {found} und {use}; eine entfernen</translation>
    </message>
    <message>
        <source>{device} has no {kind} {control}; it has {known}. Choose one of these, or a profile for this device</source>
        <translation>{device} hat {kind} {control} nicht; vorhanden: {known}. Eines davon wählen oder ein Profil für dieses Gerät</translation>
    </message>
    <message>
        <source>none</source>
        <translation>nichts</translation>
    </message>
    <message>
        <source>jitters from end to end: its potentiometer or cable is faulty</source>
        <translation>springt von Ende zu Ende: Potentiometer oder Kabel ist defekt</translation>
    </message>
    <message>
        <source>axis {axis}: the device has no axis of that name; it has {value}</source>
        <translation>Achse {axis}: das Gerät hat keine dieses Namens; vorhanden: {value}</translation>
    </message>
    <message>
        <source>rest {centre}, ends {low} and {high}</source>
        <translation>Ruhelage {centre}, Enden {low} und {high}</translation>
    </message>
    <message>
        <source>axis {axis} does not rest at an end: {where}; calibrate it as a stick</source>
        <translation>Achse {axis} ruht nicht am Ende: {where}; als Joystick kalibrieren</translation>
    </message>
    <message>
        <source>axis {axis} rests at an end: {where}; move it both ways, or declare it one-sided (a trigger)</source>
        <translation>Achse {axis} ruht am Ende: {where}; in beide Richtungen bewegen oder als einseitig angeben (Abzug)</translation>
    </message>
    <message>
        <source>axis {axis} jitters at rest, or was moved: {low} to {high} needs a dead zone of {zone}, but at most {most} is permitted; release it and measure again, or have it repaired</source>
        <translation>Achse {axis} zittert in Ruhe oder wurde bewegt: {low} bis {high} verlangt eine Totzone von {zone}, zulässig sind höchstens {most}; loslassen und neu messen, sonst reparieren lassen</translation>
    </message>
    <message>
        <source>driver {name} cannot close a loop: its samples are too infrequent and too late; use feed-forward, or the simulator</source>
        <translation>Treiber {name} kann keinen Regelkreis schließen: seine Messwerte sind dafür zu selten und zu spät; Vorsteuerung oder den Simulator verwenden</translation>
    </message>
    <message>
        <source>{name}: tuned for robot {robot}, not for {this}; tune on this robot</source>
        <translation>{name}: für Roboter {robot} abgestimmt, nicht für {this}; an diesem Roboter abstimmen</translation>
    </message>
    <message>
        <source>{name}: tuned for outputs that are {delay} intervals late, but a device&apos;s loop outputs them at once; tune with a delay of 0</source>
        <translation>{name}: für Ausgaben mit {delay} Takten Verspätung abgestimmt; der Regelkreis eines Geräts gibt sie sofort aus; mit Verzögerung 0 abstimmen</translation>
    </message>
    <message>
        <source>{number}: {error}</source>
        <translation>{number}: {error}</translation>
    </message>
    <message>
        <source>{out}; axis {axes} does not bring it back in this direction</source>
        <translation>{out}; Achse {axes} bringt sie in dieser Richtung nicht zurück</translation>
    </message>
    <message>
        <source>tip: the profile moves at {speed} within {height} of the floor, where {most} is the limit; only an armed penetration may be faster</source>
        <translation>Spitze: das Profil fährt mit {speed} weniger als {height} über dem Boden, wo {most} die Grenze ist; schneller darf dort nur eine scharfgestellte Penetration sein</translation>
    </message>
    <message>
        <source>tip: a thrust of {way} within {height} of the floor exceeds the limit of {most}</source>
        <translation>Spitze: ein Einstich von {way} weniger als {height} über dem Boden überschreitet die Grenze von {most}</translation>
    </message>
    <message>
        <source>{much} below its floor</source>
        <translation>{much} unter ihrem Boden</translation>
    </message>
    <message>
        <source>{much} above the objective&apos;s height</source>
        <translation>{much} über der Höhe des Objektivs</translation>
    </message>
    <message>
        <source>{much} outside its radius</source>
        <translation>{much} außerhalb ihres Radius</translation>
    </message>
    <message>
        <source>tip: {told} (by command or by reading). It may only move back inside: slowly, with confirmation, and by axes that bring it nearer. Move it back, or repair the faulty sensor</source>
        <translation>Spitze: {told} (nach Sollwert oder Messwert). Sie darf nur zurück nach innen fahren: langsam, mit Bestätigung und mit Achsen, die sie näher bringen. Fahren Sie sie zurück, oder reparieren Sie den fehlerhaften Sensor</translation>
    </message>
    <message>
        <source>driver {name} is a real machine, whose effects cannot be changed; connect to the simulator</source>
        <translation>Treiber {name} ist eine echte Maschine, deren Effekte sich nicht ändern lassen; mit dem Simulator verbinden</translation>
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
        <source>the device&apos;s parameters differ from the robot file ({difference}); write or accept them first</source>
        <translation>die Parameter des Geräts weichen von der Roboterdatei ab ({difference}); erst schreiben oder übernehmen</translation>
    </message>
    <message>
        <source>the position is not known yet</source>
        <translation>die Position ist noch nicht bekannt</translation>
    </message>
    <message>
        <source>the position of {axes} is not known; home first</source>
        <translation>die Position von {axes} ist unbekannt; erst Referenzfahrt</translation>
    </message>
    <message>
        <source>{reason}: the position may be wrong; home, or confirm it</source>
        <translation>{reason}: die Position kann falsch sein; Referenzfahrt oder bestätigen</translation>
    </message>
    <message>
        <source>the connection was lost</source>
        <translation>die Verbindung ging verloren</translation>
    </message>
    <message>
        <source>axis {axis}: target {target} is outside {low} to {high}, the training range of its inverse; stay inside, or remove the inverse</source>
        <translation>Achse {axis}: Ziel {target} liegt außerhalb von {low} bis {high}, dem Trainingsbereich ihrer Inversen; innerhalb bleiben oder die Inverse abschalten</translation>
    </message>
    <message>
        <source>{name}: it was trained for robot {robot}, not for {this}; train one on this robot</source>
        <translation>{name}: für Roboter {robot} trainiert, nicht für {this}; eine an diesem Roboter trainieren</translation>
    </message>
    <message>
        <source>motion is locked: {locked}</source>
        <translation>Bewegung gesperrt: {locked}</translation>
    </message>
    <message>
        <source>a motion of the nano stage is being planned; wait</source>
        <translation>eine Bewegung des Nanotischs wird geplant; bitte warten</translation>
    </message>
    <message>
        <source>the machine is still moving; release the stick first</source>
        <translation>die Maschine bewegt sich noch; erst den Joystick loslassen</translation>
    </message>
    <message>
        <source>{what}: {error}</source>
        <translation>{what}: {error}</translation>
    </message>
    <message>
        <source>the program is being closed</source>
        <extracomment>Both ends (2,), px, of the measured line.</extracomment>
        <translation>das Programm wird gerade beendet</translation>
    </message>
    <message>
        <source>a recording is running; end it first</source>
        <translation>eine Aufnahme läuft; erst beenden</translation>
    </message>
    <message>
        <source>{folder}: the folder cannot be created ({reason})</source>
        <translation>{folder}: der Ordner lässt sich nicht anlegen ({reason})</translation>
    </message>
    <message>
        <source>nothing is being recorded</source>
        <translation>es läuft keine Aufnahme</translation>
    </message>
    <message>
        <source>Recorder: {message}</source>
        <translation>Rekorder: {message}</translation>
    </message>
    <message>
        <source>The loop of the input devices failed: {name}: {error}</source>
        <translation>Die Schleife der Eingabegeräte ist ausgefallen: {name}: {error}</translation>
    </message>
    <message>
        <source>{error}; presets are used</source>
        <translation>{error}; Vorgaben werden verwendet</translation>
    </message>
    <message>
        <source>driver {name} cannot move at a set speed; send targets instead</source>
        <translation>Treiber {name} kann nicht mit vorgegebener Geschwindigkeit fahren; stattdessen Ziele senden</translation>
    </message>
    <message>
        <source>the machine is still moving; stop it or wait before homing</source>
        <translation>die Maschine bewegt sich noch; vor der Referenzfahrt anhalten oder warten</translation>
    </message>
    <message>
        <source>driver {name} cannot play trajectories</source>
        <translation>Treiber {name} kann keine Trajektorien abspielen</translation>
    </message>
    <message>
        <source>the machine is searching for its limit switches; wait, or stop it first</source>
        <translation>die Maschine sucht ihre Endschalter; warten oder erst anhalten</translation>
    </message>
    <message>
        <source>a trajectory is playing and owns every axis; stop it first</source>
        <translation>eine Trajektorie läuft und belegt alle Achsen; zuerst anhalten</translation>
    </message>
    <message>
        <source>the machine is still moving; stop it or wait before {what}</source>
        <translation>die Maschine bewegt sich noch; erst anhalten oder warten, dann: {what}</translation>
    </message>
    <message>
        <source>no profile was uploaded; upload one first</source>
        <translation>es wurde kein Profil hochgeladen; erst eines hochladen</translation>
    </message>
    <message>
        <source>axis {axis} has moved since its profile was uploaded; upload it again</source>
        <translation>Achse {axis} hat sich bewegt, seit ihr Profil hochgeladen wurde; erneut hochladen</translation>
    </message>
    <message>
        <source>driver {name} cannot capture</source>
        <translation>Treiber {name} kann nicht schnell aufzeichnen</translation>
    </message>
    <message>
        <source>driver {name} cannot set a voltage</source>
        <translation>Treiber {name} kann keine Spannung ausgeben</translation>
    </message>
    <message>
        <source>axis {axis}: {voltage} V: must be {low} to {high} V</source>
        <translation>Achse {axis}: {voltage} V: muss {low} bis {high} V sein</translation>
    </message>
    <message>
        <source>axis {axis}: a voltage acts at once, which is too fast this close to the floor of the tip; move the axis instead</source>
        <translation>Achse {axis}: eine Spannung wirkt sofort, so dicht über dem Boden der Spitze zu schnell; stattdessen verfahren</translation>
    </message>
    <message>
        <source>deviation: there is no axis {axis}</source>
        <translation>Abweichung: es gibt keine Achse {axis}</translation>
    </message>
    <message>
        <source>deviation: axis {axis}: the bound {bound} must be above 0</source>
        <translation>Abweichung: Achse {axis}: Grenze {bound}: muss über 0 liegen</translation>
    </message>
    <message>
        <source>axis {axis} deviates from the model by {deviation} for more than {time} ms; the bound is {bound}</source>
        <translation>Achse {axis} weicht länger als {time} ms um {deviation} vom Modell ab; die Grenze ist {bound}</translation>
    </message>
    <message>
        <source>{name}: playback ended early: {reason}</source>
        <translation>{name}: die Wiedergabe endete vorzeitig: {reason}</translation>
    </message>
    <message>
        <source>driver {name} cannot compensate; use the simulator</source>
        <translation>Treiber {name} kann nicht kompensieren; den Simulator verwenden</translation>
    </message>
    <message>
        <source>driver {name} cannot close a loop; use the simulator</source>
        <translation>Treiber {name} kann keinen Regelkreis schließen; den Simulator verwenden</translation>
    </message>
    <message>
        <source>driver {name} cannot play faster than real time; use the simulator</source>
        <translation>Treiber {name} kann nicht schneller als in Echtzeit abspielen; den Simulator verwenden</translation>
    </message>
    <message>
        <source>the playback is paused</source>
        <extracomment>Reasons for the stops that pause and end a playback.</extracomment>
        <translation>die Wiedergabe ist pausiert</translation>
    </message>
    <message>
        <source>a trajectory is playing; pause or stop it first</source>
        <translation>eine Trajektorie läuft; erst pausieren oder anhalten</translation>
    </message>
    <message>
        <source>Not resumed: the machine was stopped again.</source>
        <extracomment>Reason for refusing a request to resume if a stop came after it.</extracomment>
        <translation>Nicht fortgesetzt: die Maschine wurde wieder angehalten.</translation>
    </message>
    <message>
        <source>the playback is ended</source>
        <translation>die Wiedergabe ist beendet</translation>
    </message>
    <message>
        <source>axis {axis} moved {distance} since the pause; move it back first, or play the trajectory from its first row</source>
        <translation>Achse {axis} wurde seit der Pause um {distance} bewegt; erst zurückfahren oder die Trajektorie ab der ersten Zeile abspielen</translation>
    </message>
    <message>
        <source>the camera is {state}: {reason}</source>
        <translation>Kamera {state}: {reason}</translation>
    </message>
    <message>
        <source>measure: a pixel is not a finite number; draw the line again</source>
        <translation>Messen: ein Bildpunkt ist keine endliche Zahl; die Linie neu ziehen</translation>
    </message>
    <message>
        <source>{activity} is under way; wait, or stop it first</source>
        <translation>{activity} läuft; warten oder erst anhalten</translation>
    </message>
    <message>
        <source>A step of the microscope failed; the log has the cause. If this repeats, open the camera again</source>
        <translation>Ein Schritt des Mikroskops ist fehlgeschlagen; die Ursache steht im Protokoll. Wiederholt sich das, öffnen Sie die Kamera erneut</translation>
    </message>
    <message>
        <source>the tip is still {distance} px off after {n} corrections; at most {most} px are permitted: the stage drifts, or its resolution is too coarse</source>
        <translation>die Spitze liegt nach {n} Korrekturen noch {distance} px daneben; zulässig sind höchstens {most} px: der Tisch driftet, oder seine Auflösung ist zu grob</translation>
    </message>
    <message>
        <source>the tip is not visible near {column}, {row} px, where it should be; no further moves are made: check the picture</source>
        <translation>die Spitze ist bei {column}, {row} px, wo sie sein sollte, nicht zu sehen; es wird nicht weiter gefahren: Bild prüfen</translation>
    </message>
    <message>
        <source>there is no camera {key}; available: {known}</source>
        <translation>die Kamera {key} gibt es nicht; vorhanden: {known}</translation>
    </message>
    <message>
        <source>no camera is open; choose one first</source>
        <translation>keine Kamera ist geöffnet; erst eine wählen</translation>
    </message>
    <message>
        <source>{camera} ({key}), the camera used last, is not connected; plug it in, or choose another</source>
        <extracomment>Whether a view is watching. While none is, no camera is searched for or opened automatically.</extracomment>
        <translation>{camera} ({key}), die zuletzt benutzte Kamera, ist nicht angeschlossen; anstecken oder eine andere wählen</translation>
    </message>
    <message>
        <source>the calibration was stopped</source>
        <translation>die Kalibrierung wurde angehalten</translation>
    </message>
    <message>
        <source>{reason}; the return to the start position failed: {error}</source>
        <translation>{reason}; Rückfahrt zur Startposition nicht möglich: {error}</translation>
    </message>
    <message>
        <source>the picture drifted by {drift} px during the calibration; at most {most} px are permitted: let stage and camera settle, reduce backlash, and start again</source>
        <translation>das Bild driftete während der Kalibrierung um {drift} px; zulässig sind höchstens {most} px: Tisch und Kamera ruhen lassen, Umkehrspiel verringern, neu beginnen</translation>
    </message>
    <message>
        <source>the machine did not come to rest within {rest_patience_s} s; check what drives it, and start again</source>
        <translation>die Maschine kam in {rest_patience_s} s nicht zur Ruhe; nachsehen, was sie bewegt, und neu beginnen</translation>
    </message>
    <message>
        <source>frozen: it repeats earlier pictures</source>
        <extracomment>A function that returns the newest picture, or None while there is none; it never waits. Permit for every move of the run; a stop invalidates it.</extracomment>
        <translation>eingefroren: Sie wiederholt frühere Bilder</translation>
    </message>
    <message>
        <source>the camera is {what}; {count} of {pictures} new pictures arrived within {waited_s} s. Nothing moves: check the camera, and start again</source>
        <translation>die Kamera ist {what}; {count} von {pictures} neuen Bildern kamen in {waited_s} s. Nichts bewegt sich: die Kamera prüfen und neu beginnen</translation>
    </message>
    <message>
        <source>the camera shows {size}, but showed {before} at the start; keep its settings, and start again</source>
        <translation>die Kamera zeigt {size}, am Anfang waren es {before}; ihre Einstellungen nicht ändern und neu beginnen</translation>
    </message>
    <message>
        <source>the picture is black; check lamp, shutter and exposure. Nothing moves</source>
        <translation>das Bild ist schwarz; Lampe, Verschluss und Belichtung prüfen. Nichts bewegt sich</translation>
    </message>
    <message>
        <source>the machine was stopped; it stays in place</source>
        <translation>die Maschine wurde angehalten; sie bleibt, wo sie ist</translation>
    </message>
    <message>
        <source>it is not connected</source>
        <translation>sie ist nicht verbunden</translation>
    </message>
    <message>
        <source>the machine no longer moves: {reason}</source>
        <translation>die Maschine bewegt sich nicht mehr: {reason}</translation>
    </message>
    <message>
        <source>{width} × {height} px from {left}, {top}</source>
        <translation>{width} × {height} px ab {left}, {top}</translation>
    </message>
    <message>
        <source>waiting for a trigger</source>
        <translation>wartet auf Auslöser</translation>
    </message>
    <message>
        <source>no picture for {seconds} s; check the camera and its cable, or open it again</source>
        <translation>seit {seconds} s kein Bild; Kamera und Kabel prüfen oder neu öffnen</translation>
    </message>
    <message>
        <source>{name}: its thread is still running; close it first</source>
        <translation>{name}: ihr Thread läuft noch; erst schließen</translation>
    </message>
    <message>
        <source>{name} failed; the log has the cause. Check the camera and its cable, and open it again</source>
        <translation>{name} ist ausgefallen; die Ursache steht im Protokoll. Prüfen Sie Kamera und Kabel, und öffnen Sie sie erneut</translation>
    </message>
    <message>
        <source>the camera has only repeated earlier pictures for more than {seconds} s; do not trust them, and open the camera again</source>
        <translation>die Kamera wiederholt seit mehr als {seconds} s nur frühere Bilder; vertrauen Sie ihnen nicht, und öffnen Sie die Kamera erneut</translation>
    </message>
    <message>
        <source>the picture is black; check lamp, shutter, lens cap and exposure</source>
        <translation>das Bild ist schwarz; Lampe, Verschluss, Objektivdeckel und Belichtung prüfen</translation>
    </message>
    <message>
        <source>the device provides no laser readings; record the laser with its own program, play the motion from its file, and fit both records (rotemina calibrate fit --laser)</source>
        <translation>das Gerät liefert keine Laserwerte; den Laser mit seinem eigenen Programm aufzeichnen, die Bewegung aus ihrer Datei abspielen und beide Aufzeichnungen anpassen (rotemina calibrate fit --laser)</translation>
    </message>
    <message>
        <source>this run was already started; plan a new one</source>
        <translation>dieser Lauf wurde schon begonnen; einen neuen planen</translation>
    </message>
    <message>
        <source>the motion was refused</source>
        <translation>die Bewegung wurde abgelehnt</translation>
    </message>
    <message>
        <source>the calibration was cancelled</source>
        <translation>die Kalibrierung wurde abgebrochen</translation>
    </message>
    <message>
        <source>stopped; the data are discarded</source>
        <translation>angehalten; die Daten werden verworfen</translation>
    </message>
    <message>
        <source>the connection was lost; the data are discarded</source>
        <translation>die Verbindung ging verloren; die Daten werden verworfen</translation>
    </message>
    <message>
        <source>the motion ended early; the data are discarded</source>
        <translation>die Bewegung endete vorzeitig; die Daten werden verworfen</translation>
    </message>
    <message>
        <source>{name} is already open; close it first</source>
        <translation>{name}: schon geöffnet; erst schließen</translation>
    </message>
    <message>
        <source>{name}: samples of {count} axes, expected {axes}</source>
        <translation>{name}: Messwerte von {count} Achsen, erwartet {axes}</translation>
    </message>
    <message>
        <source>{name}: the device time went back from {last_time_s} s to {device_time_s} s; check whether the device was reset</source>
        <translation>{name}: die Gerätezeit sprang von {last_time_s} s zurück auf {device_time_s} s; wurde das Gerät zurückgesetzt?</translation>
    </message>
    <message>
        <source>{name}: cannot {action} while closed; open it first</source>
        <translation>{name}: geschlossen, kann nicht {action}; erst öffnen</translation>
    </message>
    <message>
        <source>{name}: cannot {action}: the device has been silent for {silent} s; wait until it answers</source>
        <translation>{name}: kann nicht {action}: das Gerät schweigt seit {silent} s; warten, bis es antwortet</translation>
    </message>
    <message>
        <source>{name}: cannot {action} during a fault ({fault}); clear it</source>
        <translation>{name}: kann im Fehlerzustand ({fault}) nicht {action}; quittieren</translation>
    </message>
    <message>
        <source>{name}: cannot {action} while the position is unknown; home first</source>
        <extracomment>A program at the other end of the line behaves like the device, byte for byte. The driver itself simulates the machine; there is no device. The version of this interface for which the class was written. Name of the device on screens and in records. Whether ``clock`` is the device&apos;s only source of time, so that it can run faster than real time. Longest interval between two calls of :meth:`read`, in which a driver serves its line, s. Largest error of a sample&apos;s time, s, if the device has no clock; 0 if it has one. The machine kind, if the driver knows it without asking a device. Every motion passes this gate. The session that uses the driver replaces it with its own.</extracomment>
        <translation>{name}: kann bei unbekannter Position nicht {action}; erst Referenzfahrt</translation>
    </message>
    <message>
        <source>{name}: cannot {action} while the position of {axes} is unknown; home first</source>
        <translation>{name}: kann bei unbekannter Position von {axes} nicht {action}; erst Referenzfahrt</translation>
    </message>
    <message>
        <source>{name}: cannot {action} while it is {state}; stop it first</source>
        <translation>{name}: kann im Zustand {state} nicht {action}; erst anhalten</translation>
    </message>
    <message>
        <source>pip install &apos;rotemina[micromanager]&apos;, then mmcore install</source>
        <translation>pip install &apos;rotemina[micromanager]&apos;, dann mmcore install</translation>
    </message>
    <message>
        <source>Micro-Manager cannot be loaded; see the log for the cause. {install}</source>
        <translation>Micro-Manager lässt sich nicht laden; die Ursache steht im Protokoll. {install}</translation>
    </message>
    <message>
        <source>configuration file of Micro-Manager (.cfg)</source>
        <translation>Konfigurationsdatei von Micro-Manager (.cfg)</translation>
    </message>
    <message>
        <source>pymmcore-plus is not installed: {install}</source>
        <translation>pymmcore-plus ist nicht installiert: {install}</translation>
    </message>
    <message>
        <source>{name}: {address}: enter a {address_hint}</source>
        <translation>{name}: {address}: bitte eingeben: {address_hint}</translation>
    </message>
    <message>
        <source>{path}: file not found; choose another configuration</source>
        <translation>{path}: diese Datei gibt es nicht; eine andere Konfiguration wählen</translation>
    </message>
    <message>
        <source>{path} names no camera; add one with Micro-Manager&apos;s wizard</source>
        <translation>{path} nennt keine Kamera; mit dem Assistenten von Micro-Manager eine hinzufügen</translation>
    </message>
    <message>
        <source>{path}: Micro-Manager cannot open it; see the log for the cause. Check the configuration with Micro-Manager&apos;s wizard, and that the camera is switched on and connected</source>
        <translation>{path}: Micro-Manager kann sie nicht öffnen; die Ursache steht im Protokoll. Prüfen Sie die Konfiguration mit dem Assistenten von Micro-Manager, und ob die Kamera eingeschaltet und angeschlossen ist</translation>
    </message>
    <message>
        <source>{name}: pixels of {getbytesperpixel} bytes: must be 8-bit or 16-bit grey, or colour; set the camera&apos;s pixel type in its configuration</source>
        <translation>{name}: Bildpunkte von {getbytesperpixel} Byte: müssen Grau mit 8 oder 16 Bit oder Farbe sein; stellen Sie den Pixeltyp der Kamera in ihrer Konfiguration ein</translation>
    </message>
    <message>
        <source>{name} rejected the settings and keeps its previous ones; see the log for the cause. Choose other values</source>
        <translation>{name} hat die Einstellungen abgelehnt und behält die bisherigen; die Ursache steht im Protokoll. Wählen Sie andere Werte</translation>
    </message>
    <message>
        <source>{name} no longer takes pictures; check that it is plugged in, and open it again</source>
        <translation>{name} nimmt keine Bilder mehr auf; prüfen Sie, ob sie angesteckt ist, und öffnen Sie sie erneut</translation>
    </message>
    <message>
        <source>{name}: Micro-Manager has lost the camera; see the log for the cause. Check that it is switched on and connected, and open it again</source>
        <translation>{name}: Micro-Manager hat die Kamera verloren; die Ursache steht im Protokoll. Prüfen Sie, ob sie eingeschaltet und angeschlossen ist, und öffnen Sie sie erneut</translation>
    </message>
    <message>
        <source>profile of {axis}: {segments} segments: must be 1 to {most_segments}</source>
        <translation>Profil von {axis}: {segments} Abschnitte: 1 bis {most_segments}</translation>
    </message>
    <message>
        <source>{where}: duration and coefficients must be finite, and the duration positive</source>
        <translation>{where}: Dauer und Koeffizienten müssen endlich sein, die Dauer auch positiv</translation>
    </message>
    <message>
        <source>{where}: {error}</source>
        <translation>{where}: {error}</translation>
    </message>
    <message>
        <source>{where}: {speed}: must be at most {most}</source>
        <translation>{where}: {speed}: höchstens {most}</translation>
    </message>
    <message>
        <source>{where}: {acceleration}: must be at most {most}</source>
        <translation>{where}: {acceleration}: höchstens {most}</translation>
    </message>
    <message>
        <source>{name}: no such axis {axis}; it has {axes}</source>
        <translation>{name}: keine Achse {axis}; vorhanden: {axes}</translation>
    </message>
    <message>
        <source>a finite number</source>
        <translation>eine endliche Zahl</translation>
    </message>
    <message>
        <source>at most {most}</source>
        <translation>höchstens {most}</translation>
    </message>
    <message>
        <source>{name}: axis {axis}: speed {speed} {unit}/s: must be {bound}</source>
        <translation>{name}: Achse {axis}: Geschwindigkeit {speed} {unit}/s: muss {bound} sein</translation>
    </message>
    <message>
        <source>a fault ({fault})</source>
        <translation>ein Fehler ({fault})</translation>
    </message>
    <message>
        <source>{name}: cannot home ({why}); wait, stop or clear it first</source>
        <translation>{name}: keine Referenzfahrt möglich: {why}; erst warten, anhalten oder quittieren</translation>
    </message>
    <message>
        <source>{name}: lease of {lease} s: must be more than 0 s and at most {longest} s</source>
        <translation>{name}: Gültigkeit von {lease} s: muss mehr als 0 s und höchstens {longest} s betragen</translation>
    </message>
    <message>
        <source>no axis</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>{name}: axis {axis} has no limit switch; axes with one: {have}</source>
        <translation>{name}: Achse {axis} hat keinen Endschalter; Achsen mit Endschalter: {have}</translation>
    </message>
    <message>
        <source>{name}: cannot set a voltage while it is {state}; stop it or wait</source>
        <translation>{name}: kann im Zustand {state} keine Spannung ausgeben; anhalten oder warten</translation>
    </message>
    <message>
        <source>{name}: axis {axis} has no amplifier with a voltage range</source>
        <translation>{name}: Achse {axis} hat keinen Verstärker mit Spannungsbereich</translation>
    </message>
    <message>
        <source>{name}: axis {axis}: {voltage} V: must be {low} to {high} V</source>
        <translation>{name}: Achse {axis}: {voltage} V: muss {low} bis {high} V sein</translation>
    </message>
    <message>
        <source>{name}: capture of {axes} axes: must be 1 to {most}</source>
        <translation>{name}: schnelle Aufzeichnung von {axes} Achsen: 1 bis {most}</translation>
    </message>
    <message>
        <source>{name}: capture of {axes} axes at {rate_hz} Hz: must be at most {most} Hz</source>
        <translation>{name}: schnelle Aufzeichnung von {axes} Achsen mit {rate_hz} Hz: höchstens {most} Hz</translation>
    </message>
    <message>
        <source>{name}: capture of {count} samples: must be 1 to {most}</source>
        <translation>{name}: schnelle Aufzeichnung von {count} Messwerten: 1 bis {most}</translation>
    </message>
    <message>
        <source>{name}: cannot accept a profile while it is {state}</source>
        <translation>{name}: nimmt im Zustand {state} kein Profil an</translation>
    </message>
    <message>
        <source>{name}: row {row} of the display: must be 0 or {last}</source>
        <translation>{name}: Zeile {row} der Anzeige: 0 oder {last}</translation>
    </message>
    <message>
        <source>{name}: cannot write its parameters while it is {state}</source>
        <translation>{name}: kann seine Parameter im Zustand {state} nicht schreiben</translation>
    </message>
    <message>
        <source>{name} is still {state}; stop it or wait before playing</source>
        <translation>{name}: noch im Zustand {state}; vor der Wiedergabe anhalten oder warten</translation>
    </message>
    <message>
        <source>an interrupt&apos;s path has neither CLI nor RTI</source>
        <translation>der Pfad eines Interrupts enthält weder CLI noch RTI</translation>
    </message>
    <message>
        <source>robot {name}: pin_length {pin_length} must be greater than the end of zn&apos;s range, {end}</source>
        <translation>Roboter {name}: pin_length {pin_length} muss größer sein als das Ende des Bereichs von zn, {end}</translation>
    </message>
    <message>
        <source>robot {name}: axis {axis} may tilt from {low} rad to {high} rad; the kinematic chain is valid for tilts below {most} rad</source>
        <translation>Roboter {name}: Achse {axis} darf von {low} rad bis {high} rad kippen; die kinematische Kette gilt für Kippwinkel unter {most} rad</translation>
    </message>
    <message>
        <source>axis {axis}: position {value} is outside its bounds, {low} to {high}; choose a tip position or a tilt inside the workspace</source>
        <translation>Achse {axis}: Position {value} liegt außerhalb ihrer Grenzen {low} bis {high}; eine Spitzenposition oder einen Kippwinkel im Arbeitsraum wählen</translation>
    </message>
    <message>
        <source>axis {axis}: position {value} at row {row} is outside its bounds, {low} to {high}; choose a tip position or a tilt inside the workspace</source>
        <translation>Achse {axis}: Position {value} in Zeile {row} liegt außerhalb ihrer Grenzen {low} bis {high}; eine Spitzenposition oder einen Kippwinkel im Arbeitsraum wählen</translation>
    </message>
    <message>
        <source>robot {name} has no axis {missing}; the hybrid chain needs axes named {joints}, and this robot has {axes}</source>
        <translation>Roboter {name}: Achse {missing} fehlt; die hybride Kette braucht die Achsen {joints}, dieser Roboter hat {axes}</translation>
    </message>
    <message>
        <source>robot {name}: axis {axis} moves in {unit}; the hybrid chain needs {needed}</source>
        <translation>Roboter {name}: Achse {axis} bewegt sich in {unit}; die hybride Kette braucht {needed}</translation>
    </message>
    <message>
        <source>robot {name}: pin_length missing; the hybrid chain needs the length from the pivot to the tip, [robot] pin_length in m</source>
        <translation>Roboter {name}: pin_length fehlt; die hybride Kette braucht die Länge vom Drehpunkt zur Spitze, [robot] pin_length in m</translation>
    </message>
    <message>
        <source>{error}; [keep_out] needs a tip to limit</source>
        <translation>{error}; [keep_out] braucht eine Spitze</translation>
    </message>
    <message>
        <source>tip: floor {floor} mm: must be between {low} and {high}, within the reach of the tip; teach it where the tip touches</source>
        <translation>Spitze: Boden bei {floor} mm: muss zwischen {low} und {high} liegen, wo die Spitze sein kann; dort setzen, wo die Spitze aufsetzt</translation>
    </message>
    <message>
        <source>on the way</source>
        <translation>unterwegs</translation>
    </message>
    <message>
        <source>at {time} s</source>
        <translation>bei {time} s</translation>
    </message>
    <message>
        <source>tip: descends at {speed} at {time} s, {height} high; within {near} of its floor {floor} the limit is {most}: make the approach slower</source>
        <translation>Spitze: sinkt bei {time} s mit {speed} in der Höhe {height}: weniger als {near} über ihrem Boden {floor} höchstens {most}; langsamer annähern</translation>
    </message>
    <message>
        <source>tip: {lowest} high {where}, but its floor is {floor}; move elsewhere first, or teach the floor</source>
        <translation>Spitze: {where} in der Höhe {lowest}: ihr Boden liegt bei {floor}; erst anderswohin fahren oder den Boden setzen</translation>
    </message>
    <message>
        <source>tip: {lowest} high {where}, but its floor is {low}, where the objective is; stay above it</source>
        <translation>Spitze: {where} in der Höhe {lowest}: ihr Boden liegt bei {low}, wo das Objektiv ist; darüber bleiben</translation>
    </message>
    <message>
        <source>tip: {highest} high {where}, but the objective is at {high}; stay below it</source>
        <translation>Spitze: {where} in der Höhe {highest}: das Objektiv ist bei {high}; darunter bleiben</translation>
    </message>
    <message>
        <source>tip: {away} from the middle {where}, but at most {radius} is permitted; move one axis after the other, or less far</source>
        <translation>Spitze: {where} {away} von der Mitte entfernt: höchstens {radius}; eine Achse nach der anderen bewegen oder weniger weit</translation>
    </message>
    <message>
        <source>registration: an image of {columns} × {rows} px against a reference of {other_columns} × {other_rows} px; use one camera setting for both</source>
        <translation>Registrierung: ein Bild von {columns} × {rows} px gegen eine Referenz von {other_columns} × {other_rows} px; für beide dieselbe Kameraeinstellung verwenden</translation>
    </message>
    <message>
        <source>registration: peak-to-sidelobe ratio {ratio}, must be at least {least_peak_to_sidelobe}; the images share too little detail, or repeating detail: focus, increase the light, make the move smaller, or bring another object into view</source>
        <translation>Registrierung: Verhältnis von Hauptmaximum zu Nebenmaximum {ratio}, muss mindestens {least_peak_to_sidelobe} sein; die Bilder zeigen zu wenig gemeinsame Einzelheiten oder solche, die sich wiederholen: scharf stellen, mehr Licht geben, die Bewegung verkleinern oder ein anderes Objekt ins Bild bringen</translation>
    </message>
    <message>
        <source>registration: a second shift fits {rival} % as well, must be at most {most_second_peak} %; the picture repeats itself (a grating?): use another object or smaller moves</source>
        <translation>Registrierung: eine zweite Verschiebung passt zu {rival} % ebenso, höchstens {most_second_peak} % sind erlaubt; das Bild wiederholt sich (ein Gitter?): ein anderes Objekt oder kleinere Bewegungen verwenden</translation>
    </message>
    <message>
        <source>registration: the picture moved by {right}, {down} px and hardly overlaps the previous one; make the move smaller</source>
        <translation>Registrierung: Das Bild bewegte sich um {right}, {down} px und überlappt das vorige kaum; verkleinern Sie die Bewegung</translation>
    </message>
    <message>
        <source>registration: the images cannot be aligned; they differ by more than a shift (rotation, another focus, or motion of only a part of the scene)</source>
        <translation>Registrierung: die Bilder lassen sich nicht übereinanderlegen; sie unterscheiden sich um mehr als eine Verschiebung (gedreht, anders scharf gestellt, oder nur ein Teil der Szene hat sich bewegt)</translation>
    </message>
    <message>
        <source>calibration: moves of shape {shape} against shifts of shape {shifts_shape}; both must be (moves, 2)</source>
        <translation>Kalibrierung: Bewegungen der Form {shape} gegen Verschiebungen der Form {shifts_shape}; beide müssen (Bewegungen, 2) sein</translation>
    </message>
    <message>
        <source>calibration: a move or shift is not a finite number; start again</source>
        <translation>Kalibrierung: eine Bewegung oder Verschiebung ist keine endliche Zahl; neu beginnen</translation>
    </message>
    <message>
        <source>calibration: {n} moves, must be at least {least}; increase the number of moves</source>
        <translation>Kalibrierung: {n} Bewegungen, mindestens {least} sind nötig; erhöhen Sie ihre Anzahl</translation>
    </message>
    <message>
        <source>calibration: the moves do not span the plane: their extent across the main direction is {part} % of that along it, must be at least {least} %; move both axes</source>
        <translation>Kalibrierung: Die Bewegungen spannen die Ebene nicht auf: Quer zur Hauptrichtung reichen sie {part} % so weit wie längs, mindestens {least} % sind nötig; bewegen Sie beide Achsen</translation>
    </message>
    <message>
        <source>calibration: {bad} of {n} moves do not fit, must be at most {most} %; something else moved, or the tracking slipped: check the picture, and start again</source>
        <translation>Kalibrierung: {bad} von {n} Bewegungen passen nicht, höchstens {most} %; anderes bewegte sich oder die Verfolgung verrutschte: Bild prüfen, neu beginnen</translation>
    </message>
    <message>
        <source>calibration: residuals of {rms} px rms (greatest at move {worst}), must be at most {most} px; backlash, drift or a loose tool: let the stage settle, home it, and start again</source>
        <translation>Kalibrierung: Restfehler {rms} px rms (größter bei Bewegung {worst}), höchstens {most} px; Umkehrspiel, Drift oder loses Werkzeug: Tisch ruhen lassen, Referenzfahrt, neu beginnen</translation>
    </message>
    <message>
        <source>calibration: both axes move the picture in nearly the same direction ({angle}° apart, must be at least {least}°); one of them does not move, or moves along the view</source>
        <translation>Kalibrierung: beide Achsen bewegen das Bild fast gleich gerichtet ({angle}° auseinander, mindestens {least}°); eine bewegt sich nicht oder entlang der Blickrichtung</translation>
    </message>
    <message>
        <source>calibration: the pixel size is uncertain by {known} %, must be at most {asked} %; make larger or more moves</source>
        <translation>Kalibrierung: die Pixelgröße ist auf {known} % unsicher, höchstens {asked} % sind erlaubt; größere oder mehr Bewegungen ausführen</translation>
    </message>
    <message>
        <source>focus: {count} pictures, must be at least {least_looks} with finite sharpness; use more positions</source>
        <translation>Autofokus: {count} Bilder, nötig sind mindestens {least_looks} mit endlicher Schärfe; mehr Positionen verwenden</translation>
    </message>
    <message>
        <source>focus: all pictures are equally sharp; bring detail into view</source>
        <translation>Autofokus: alle Bilder sind gleich scharf; Details ins Bild bringen</translation>
    </message>
    <message>
        <source>focus: the sharpness has no distinct peak; bring detail into view, increase the light, or search a larger range</source>
        <translation>Autofokus: die Schärfe hat kein deutliches Maximum; Details ins Bild bringen, mehr Licht geben oder in einem größeren Bereich suchen</translation>
    </message>
    <message>
        <source>focus: the peak, {width} µm wide, is narrower than the spacing of the pictures; it is noise, or the spacing must be smaller</source>
        <translation>Autofokus: das Maximum, {width} µm breit, ist schmaler als der Abstand der Bilder; es ist Rauschen, oder der Abstand muss kleiner sein</translation>
    </message>
    <message>
        <source>focus: the sharpest position would be {place} µm, outside the searched range {low} to {high} µm; search there</source>
        <translation>Autofokus: am schärfsten wäre es bei {place} µm, außerhalb des abgesuchten Bereichs {low} bis {high} µm; dort suchen</translation>
    </message>
    <message>
        <source>focus: {low} m to {high} m is not a range; low must be below high</source>
        <translation>Autofokus: {low} m bis {high} m ist kein Bereich; das untere Ende muss unter dem oberen liegen</translation>
    </message>
    <message>
        <source>focus: the search has ended; start a new one</source>
        <translation>Autofokus: die Suche ist zu Ende; eine neue beginnen</translation>
    </message>
    <message>
        <source>tip: nothing in the picture matches it (best match {likeness}); bring the tip into view and near focus, or correct its direction in the image</source>
        <translation>Spitze: nichts im Bild passt zu ihr (beste Übereinstimmung {likeness}); die Spitze ins Bild und nahe an den Fokus bringen oder ihre Richtung im Bild berichtigen</translation>
    </message>
    <message>
        <source>tip: nothing in the picture looks like a pipette in any direction; bring the tip into view and near focus</source>
        <translation>Spitze: nichts im Bild sieht in irgendeiner Richtung wie eine Pipette aus; die Spitze ins Bild und nahe an den Fokus bringen</translation>
    </message>
    <message>
        <source>drift: {most} of {count} parts of the picture agree on a shift, must be at least {least} and half of the {seen} with enough detail; bring a background with detail into view and focus</source>
        <translation>Drift: {most} von {count} Teilen des Bilds zeigen dieselbe Verschiebung, mindestens {least} und die Hälfte der {seen} mit genug Details sind nötig; einen Hintergrund mit Details ins Bild und in den Fokus bringen</translation>
    </message>
    <message>
        <source>cell: radii {low} to {high} px; must be more than 2 and increasing</source>
        <translation>Zelle: Radien {low} bis {high} px; müssen größer als 2 und ansteigend sein</translation>
    </message>
    <message>
        <source>cell: the line around {column}, {row} px absorbs {darker} % of the light, must be at least {least} %; focus on the membrane, or click into the cell</source>
        <translation>Zelle: die Linie um {column}, {row} px absorbiert {darker} % des Lichts, mindestens {least} % sind nötig; auf die Membran fokussieren oder in die Zelle klicken</translation>
    </message>
    <message>
        <source>cell: the outline deviates from an ellipse by {rms} px rms, must be at most {most} % of its radius; click into the middle of one cell</source>
        <translation>Zelle: ihr Umriss weicht {rms} px rms von einer Ellipse ab, höchstens {most} % des Radius; in die Mitte einer Zelle klicken</translation>
    </message>
    <message>
        <source>nothing matches it at its expected position</source>
        <translation>an der erwarteten Position passt nichts zu ihr</translation>
    </message>
    <message>
        <source>only {part} % of its surroundings match</source>
        <translation>nur {part} % ihrer Umgebung stimmen überein</translation>
    </message>
    <message>
        <source>its position is uncertain by {doubt} px</source>
        <translation>ihre Position ist um {doubt} px unsicher</translation>
    </message>
    <message>
        <source>the object there absorbs {part} % of the light</source>
        <translation>das Objekt dort absorbiert {part} % des Lichts</translation>
    </message>
    <message>
        <source>its contrast has changed to {part} %</source>
        <translation>ihr Kontrast hat sich auf {part} % geändert</translation>
    </message>
    <message>
        <source>stop and lock</source>
        <translation>Halt und sperren</translation>
    </message>
    <message>
        <source>Stopped by the {who} at {time}: {why}</source>
        <translation>Angehalten durch {who} um {time}: {why}</translation>
    </message>
    <message>
        <source>Stopped by the {who} at {time}</source>
        <translation>Angehalten durch {who} um {time}</translation>
    </message>
    <message>
        <source>not the run of a penetration: {error}</source>
        <translation>kein Lauf einer Penetration: {error}</translation>
    </message>
    <message>
        <source>{path}: cannot be written: {strerror}</source>
        <translation>{path}: kann nicht geschrieben werden: {strerror}</translation>
    </message>
    <message>
        <source>{path}: the run was not written completely; the disk may be full</source>
        <translation>{path}: der Lauf wurde nicht vollständig geschrieben; der Datenträger ist vielleicht voll</translation>
    </message>
    <message>
        <source>axis = {axis}: must be the name of an axis</source>
        <translation>axis = {axis}: muss der Name einer Achse sein</translation>
    </message>
    <message>
        <source>table: must be given if and only if shape is &apos;table&apos; (shape is {shape}, the table has {count} points)</source>
        <translation>Tabelle: genau dann nötig, wenn die Form &apos;table&apos; ist (die Form ist {shape}, die Tabelle hat {count} Punkte)</translation>
    </message>
    <message>
        <source>{name}: {error}</source>
        <translation>{name}: {error}</translation>
    </message>
    <message>
        <source>{key} = {value}: unknown key</source>
        <translation>{key} = {value}: unbekannter Schlüssel</translation>
    </message>
    <message>
        <source>{name} = {value}: must be one of {known}</source>
        <translation>{name} = {value}: muss eines von {known} sein</translation>
    </message>
    <message>
        <source>{name} = {value}: must be a finite number</source>
        <translation>{name} = {value}: muss eine endliche Zahl sein</translation>
    </message>
    <message>
        <source>{name} = {value}: must be {least} to {most}</source>
        <translation>{name} = {value}: muss zwischen {least} und {most} liegen</translation>
    </message>
    <message>
        <source>table: must be a list of at most {most_points} points</source>
        <translation>Tabelle: muss eine Liste von höchstens {most_points} Punkten sein</translation>
    </message>
    <message>
        <source>table, point {number} = {row}: must be [time, depth]</source>
        <translation>Tabelle, Punkt {number} = {row}: muss [Zeit, Tiefe] sein</translation>
    </message>
    <message>
        <source>table: must go from [0, 0] to [1, 1]</source>
        <translation>Tabelle: muss von [0, 0] bis [1, 1] reichen</translation>
    </message>
    <message>
        <source>contact: {count} samples at rest, but at least {least_samples} are needed to measure the noise; wait</source>
        <translation>Kontakt: {count} Abtastwerte in Ruhe, mindestens {least_samples} sind nötig, um das Rauschen zu messen; warten</translation>
    </message>
    <message>
        <source>bounds: range {low} to {high}, speed {max_speed}, acceleration {max_acceleration}: they must be finite, the range not empty, speed and acceleration above 0</source>
        <translation>Grenzen: Bereich {low} bis {high}, Geschwindigkeit {max_speed}, Beschleunigung {max_acceleration}: sie müssen endlich sein, der Bereich nicht leer, Geschwindigkeit und Beschleunigung über 0</translation>
    </message>
    <message>
        <source>impedance: forces of up to {force} could accelerate the mass of {mass} by {reached} per s², but the axis permits {max_acceleration}; lower the force, or use a mass of about {wanted} with the same damping ratio or time constant</source>
        <translation>Impedanz: Kräfte bis {force} könnten die Masse {mass} mit {reached} je s² beschleunigen, die Achse erlaubt {max_acceleration}; die Kraft verringern oder eine Masse von etwa {wanted} mit demselben Dämpfungsgrad oder derselben Zeitkonstante verwenden</translation>
    </message>
    <message>
        <source>{path}: device = {device}: this is the file of {key}; calibrate the device again</source>
        <translation>{path}: device = {device}: dies ist die Datei von {key}; das Gerät neu kalibrieren</translation>
    </message>
    <message>
        <source>the calibration of {device} cannot be stored for {key}</source>
        <translation>eine Kalibrierung von {device} kann nicht für {key} gespeichert werden</translation>
    </message>
    <message>
        <source>mode {name}: robot {robot} has no such mode (it needs the axes of the hybrid chain); use one of {names}</source>
        <extracomment>Modes of a robot with a tip. Only one mode is active at a time.</extracomment>
        <translation>Modus {name}: Roboter {robot} hat ihn nicht (er braucht die Achsen der Hybridkette); möglich: {names}</translation>
    </message>
    <message>
        <source>mode {name}: robot {robot} has no such mode; use one of {names}</source>
        <translation>Modus {name}: Roboter {robot} hat ihn nicht; möglich: {names}</translation>
    </message>
    <message>
        <source>contact: gain {gain}, noise {noise}, greatest force {most}, slope {slope}, step {longest_step_s} s, delay {delay_s} s: all must be finite and not below 0, slope and step above 0</source>
        <translation>Kontakt: Verstärkung {gain}, Rauschen {noise}, größte Kraft {most}, Steigung {slope}, Schritt {longest_step_s} s, Verzögerung {delay_s} s: alle müssen endlich und nicht kleiner als 0 sein, Steigung und Schritt über 0</translation>
    </message>
    <message>
        <source>contact: with gain {gain} the stick&apos;s mechanism might release more energy than it received: at most {most} is permitted with a damping of {damping} N s/m and readings {delay_s} ms old; lower the gain or raise the damping</source>
        <translation>Kontakt: mit Verstärkung {gain} könnte die Mechanik des Joysticks mehr Energie abgeben, als sie bekam: höchstens {most} bei einer Dämpfung von {damping} N s/m und {delay_s} ms alten Messwerten; die Verstärkung verringern oder die Dämpfung erhöhen</translation>
    </message>
    <message>
        <source>{device} has neither axes nor buttons to map</source>
        <translation>{device} hat weder Achsen noch Tasten, die sich zuordnen ließen</translation>
    </message>
    <message>
        <source>the program releases it</source>
        <extracomment>The profile in use, or None.</extracomment>
        <translation>das Programm gibt es frei</translation>
    </message>
    <message>
        <source>re-centring: {value}: must be one of thx, thy, zn; only these have a middle to return to</source>
        <translation>Zurückstellen: {value}: muss thx, thy oder zn sein; nur diese haben eine Mitte</translation>
    </message>
    <message>
        <source>no joint</source>
        <translation>keine Achse</translation>
    </message>
    <message>
        <source>re-centring: the position of axis {names} is not known; connect and home first</source>
        <translation>Zurückstellen: die Position der Achse {names} ist nicht bekannt; erst verbinden und referenzieren</translation>
    </message>
    <message>
        <source>{source}: {problem}</source>
        <translation>{source}: {problem}</translation>
    </message>
    <message>
        <source>{parent}: the folder cannot be created ({strerror}); choose another</source>
        <translation>{parent}: der Ordner lässt sich nicht anlegen ({strerror}); einen anderen wählen</translation>
    </message>
    <message>
        <source>{key}: missing; {need}</source>
        <translation>{key}: fehlt; {need}</translation>
    </message>
    <message>
        <source>the file needs it</source>
        <translation>die Datei braucht es</translation>
    </message>
    <message>
        <source>{key}: unknown key</source>
        <translation>{key}: unbekannter Schlüssel</translation>
    </message>
    <message>
        <source>{key}: {bound}</source>
        <translation>{key}: {bound}</translation>
    </message>
    <message>
        <source>mode: the position of axis {names} is not known; connect and home first</source>
        <translation>Modus: die Position der Achse {names} ist nicht bekannt; erst verbinden und referenzieren</translation>
    </message>
    <message>
        <source>0 or more</source>
        <translation>mindestens 0</translation>
    </message>
    <message>
        <source>above 0</source>
        <translation>größer als 0</translation>
    </message>
    <message>
        <source>impedance: {name} {value} must be finite and {least}</source>
        <translation>Impedanz: {name} {value}: muss endlich und {least} sein</translation>
    </message>
    <message>
        <source>impedance: with stiffness {stiffness} the force {force} reaches {travel} m (or rad), more than {most_travel}; use 0 for no spring</source>
        <translation>Impedanz: mit Steifigkeit {stiffness} reicht die Kraft {force} bis {travel} m (oder rad), höchstens {most_travel} sind erlaubt; 0 für keine Feder verwenden</translation>
    </message>
    <message>
        <source>impedance: damping ratio {damping_ratio} is below {least_damping_ratio}, so the axis would ring; use a damping of {least_damping} or more</source>
        <translation>Impedanz: Dämpfungsgrad {damping_ratio} liegt unter {least_damping_ratio}, die Achse würde schwingen; eine Dämpfung von mindestens {least_damping} verwenden</translation>
    </message>
    <message>
        <source>scaling: step of {dt} s with a reaction of {reaction}: both must be finite, the step 0 or more</source>
        <translation>Maßstab: Schritt von {dt} s bei einer Reaktion von {reaction}: beide müssen endlich sein, der Schritt nicht kleiner als 0</translation>
    </message>
    <message>
        <source>scaling: factor {factor} must be finite and above 0</source>
        <translation>Maßstab: Faktor {factor}: muss endlich und größer als 0 sein</translation>
    </message>
    <message>
        <source>{what}: scale {scale} must be finite and not 0</source>
        <translation>{what}: Maßstab {scale}: muss endlich und nicht 0 sein</translation>
    </message>
    <message>
        <source>scaling: the deflection {value} is not a finite number</source>
        <translation>Maßstab: die Auslenkung {value} ist keine endliche Zahl</translation>
    </message>
    <message>
        <source>{path}: the name of an interrupted recording ends with {unfinished}</source>
        <translation>{path}: eine abgebrochene Aufnahme endet auf {unfinished}</translation>
    </message>
    <message>
        <source>{error}; the recorded data are in {source}</source>
        <translation>{error}; das Aufgezeichnete steht in {source}</translation>
    </message>
    <message>
        <source>{source}: interrupted before anything was recorded; delete it</source>
        <translation>{source}: abgebrochen, bevor etwas aufgezeichnet war; löschen</translation>
    </message>
    <message>
        <source>{source}: version {get}, but this program reads version {version}; recover it with the program that recorded it</source>
        <translation>{source}: Version {get}, dieses Programm liest aber {version}; mit dem Programm wiederherstellen, das sie aufgezeichnet hat</translation>
    </message>
    <message>
        <source>{target} already exists and is another recording; rename it, then recover {source}</source>
        <translation>{target}: gibt es schon und ist eine andere Aufnahme; umbenennen, dann {source} wiederherstellen</translation>
    </message>
    <message>
        <source>{path}: the recording is unfinished; recover it first</source>
        <translation>{path}: die Aufnahme ist unvollendet; erst wiederherstellen</translation>
    </message>
    <message>
        <source>name a recording</source>
        <translation>eine Aufnahme angeben</translation>
    </message>
    <message>
        <source>{path}: not a recording of this program, or damaged ({error})</source>
        <translation>{path}: keine Aufnahme dieses Programms oder eine beschädigte ({error})</translation>
    </message>
    <message>
        <source>{path}: not a recording of this program</source>
        <translation>{path}: keine Aufnahme dieses Programms</translation>
    </message>
    <message>
        <source>{path}: recording of version {decode}, but this program reads version {version}</source>
        <translation>{path}: eine Aufnahme der Version {decode}; dieses Programm liest {version}</translation>
    </message>
    <message>
        <source>{path}: damaged, {names} missing</source>
        <translation>{path}: beschädigt, es fehlen: {names}</translation>
    </message>
    <message>
        <source>{path}: damaged, began_s is {about}</source>
        <translation>{path}: beschädigt, began_s ist {about}</translation>
    </message>
    <message>
        <source>{path}: damaged, {name} is not a table of a recording</source>
        <translation>{path}: beschädigt, Tabelle {name} gehört zu keiner Aufnahme</translation>
    </message>
    <message>
        <source>{path} already exists; record to another name</source>
        <translation>{path}: gibt es schon; unter anderem Namen aufzeichnen</translation>
    </message>
    <message>
        <source>{path}: cannot be written ({reason}); make room, or choose another folder</source>
        <translation>{path}: kann nicht geschrieben werden ({reason}); Platz schaffen oder einen anderen Ordner wählen</translation>
    </message>
    <message>
        <source>{name}: the end of the recording could not be written ({failure})</source>
        <extracomment>Host time at which the recording began, s. Why nothing can be written at present; None if writing works.</extracomment>
        <translation>{name}: das Ende konnte nicht geschrieben werden ({failure})</translation>
    </message>
    <message>
        <source>{samples} samples and {others} other entries are missing</source>
        <translation>{samples} Abtastwerte und {others} andere Einträge fehlen</translation>
    </message>
    <message>
        <source>nothing is missing</source>
        <translation>es fehlt nichts</translation>
    </message>
    <message>
        <source>{name}: the disk took {took_s} s for a segment: a crash or a power cut now could lose more than a second; record to a faster disk</source>
        <translation>{name}: der Datenträger brauchte {took_s} s für ein Segment: ein Absturz oder Stromausfall könnte jetzt mehr als eine Sekunde kosten; zeichnen Sie auf einen schnelleren Datenträger auf</translation>
    </message>
    <message>
        <source>{path}: no axis was commanded to move in this section</source>
        <translation>{path}: in diesem Abschnitt wurde keine Achse bewegt</translation>
    </message>
    <message>
        <source>{path}: no samples in this section; the recording lasts {whole_s} s</source>
        <translation>{path}: keine Abtastwerte in diesem Abschnitt; sie dauert {whole_s} s</translation>
    </message>
    <message>
        <source>{path}: axis {axis} moves at the start; every axis must rest there for {rest_s} s: choose an earlier start</source>
        <extracomment>Metadata that an exported record copies from its recording.</extracomment>
        <translation>{path}: Achse {axis} bewegt sich am Anfang; dort muss jede Achse {rest_s} s stehen: einen früheren Anfang wählen</translation>
    </message>
    <message>
        <source>{path}: axis {axis} moves at the end; every axis must rest there for {rest_s} s: choose a later end</source>
        <translation>{path}: Achse {axis} bewegt sich am Ende; dort muss jede Achse {rest_s} s stehen: ein späteres Ende wählen</translation>
    </message>
    <message>
        <source>{path} already exists, being recorded or left by a crash; record to another name, or recover it</source>
        <translation>{path}: gibt es schon, wird gerade aufgezeichnet oder blieb von einem Absturz; unter anderem Namen aufzeichnen oder wiederherstellen</translation>
    </message>
    <message>
        <source>{path}: cannot be created ({reason}); choose another folder</source>
        <translation>{path}: kann nicht angelegt werden ({reason}); einen anderen Ordner wählen</translation>
    </message>
    <message>
        <source>{path}: in use by another program; record to another name</source>
        <translation>{path}: von einem anderen Programm benutzt; unter anderem Namen aufzeichnen</translation>
    </message>
    <message>
        <source>{path}: cannot be read ({reason})</source>
        <translation>{path}: kann nicht gelesen werden ({reason})</translation>
    </message>
    <message>
        <source>{path}: still being recorded; end the recording first</source>
        <translation>{path}: wird noch aufgezeichnet; das erst beenden</translation>
    </message>
    <message>
        <source>{path}: interrupted before anything was recorded; delete it</source>
        <translation>{path}: abgebrochen, bevor etwas aufgezeichnet war; löschen</translation>
    </message>
    <message>
        <source>{path}: version {version}, but this program reads version {known}; recover it with the program that recorded it</source>
        <translation>{path}: Version {version}, dieses Programm liest aber {known}; mit dem Programm wiederherstellen, das sie aufgezeichnet hat</translation>
    </message>
    <message>
        <source>{path}: not an interrupted recording of this program</source>
        <translation>{path}: keine abgebrochene Aufnahme dieses Programms</translation>
    </message>
    <message>
        <source>the robot file has changed</source>
        <extracomment>Metadata key under which a record lists the faults and contacts that occurred during it. Effects that a diagnosis may report if the machine touched a cell, a dish or an end stop. Effects that cannot be predicted from commands, in addition to random and time-locked effects.</extracomment>
        <translation>die Roboterdatei hat sich geändert</translation>
    </message>
    <message>
        <source>it was made for driver {driver}, but this is {other_driver}</source>
        <translation>es wurde für Treiber {driver} gemacht, dies ist {other_driver}</translation>
    </message>
    <message>
        <source>the boards&apos; parameters have changed</source>
        <translation>die Parameter der Karten haben sich geändert</translation>
    </message>
    <message>
        <source>the diagnosis belongs to an earlier state of the robot file {name}; the one in use, {robot_name}, differs: choose the model in use, and diagnose again</source>
        <translation>die Diagnose gilt für die damalige Roboterdatei {name}; die aktuelle, {robot_name}, ist eine andere: das verwendete Modell wählen und neu diagnostizieren</translation>
    </message>
    <message>
        <source>the diagnosis found nothing that commands can predict: the nominal model is as good</source>
        <translation>die Diagnose fand nichts, was sich aus Sollwerten vorhersagen lässt; das nominale Modell ist ebenso gut</translation>
    </message>
    <message>
        <source>playback: the device went from row {from_row} to row {to_row} of a trajectory whose rows are 0 to {last}</source>
        <translation>Wiedergabe: das Gerät sprang von Zeile {from_row} zu Zeile {to_row} einer Trajektorie mit den Zeilen 0 bis {last}</translation>
    </message>
    <message>
        <source>robot {name}: [microscope] pixel_size and magnification are missing; they determine the tip&apos;s shape in the picture</source>
        <translation>Roboter {name}: [microscope] pixel_size und magnification fehlen; ohne sie ist die Form der Spitze nicht bekannt</translation>
    </message>
    <message>
        <source>objective: the name is empty; enter one, such as &quot;20x&quot;</source>
        <translation>Objektiv: der Name ist leer; einen angeben, etwa &quot;20x&quot;</translation>
    </message>
    <message>
        <source>the tip would move {distance}, more than {confirm_m}; confirm the move first</source>
        <translation>die Spitze würde {distance} weit fahren, mehr als {confirm_m}; die Bewegung erst bestätigen</translation>
    </message>
    <message>
        <source>the camera is not calibrated with this objective; calibrate it before clicking</source>
        <translation>die Kamera ist mit diesem Objektiv nicht kalibriert; vor dem Klicken kalibrieren</translation>
    </message>
    <message>
        <source>no position is known; connect the machine first</source>
        <translation>keine Position ist bekannt; erst die Maschine verbinden</translation>
    </message>
    <message>
        <source>the click at {x}, {y} px is outside the calibrated field, 0 to {width} and 0 to {height} px; click inside</source>
        <translation>der Klick bei {x}, {y} px liegt außerhalb des kalibrierten Felds, 0 bis {width} und 0 bis {height} px; innerhalb klicken</translation>
    </message>
    <message>
        <source>the {name} stage is not calibrated for objective {objective} on camera {camera}; calibrate it first</source>
        <translation>der Tisch {name} ist für Objektiv {objective} an Kamera {camera} nicht kalibriert; erst kalibrieren</translation>
    </message>
    <message>
        <source>every target has been visited; mark more targets</source>
        <translation>alle Ziele wurden besucht; weitere Ziele markieren</translation>
    </message>
    <message>
        <source>there is no target {index}; there are {count}</source>
        <translation>das Ziel {index} gibt es nicht; vorhanden: {count}</translation>
    </message>
    <message>
        <source>axis {axis}: the microscope measures only {names}; depth has no zero</source>
        <translation>Achse {axis}: das Mikroskop zeigt nur die Orte von {names}; die Tiefe hat keinen Nullpunkt</translation>
    </message>
    <message>
        <source>{path}: the recording contains no tip; calibrate, and track the tip while recording</source>
        <translation>{path}: darin ist keine Spitze; kalibrieren und die Spitze beim Aufzeichnen verfolgen</translation>
    </message>
    <message>
        <source>{path}: none of the {count} pictures shows where the tip is; calibrate the micro stage before recording</source>
        <translation>{path}: {count} Bilder, und keines zeigt, wo die Spitze ist; vor dem Aufzeichnen den Mikrotisch kalibrieren</translation>
    </message>
    <message>
        <source>{name}: its position is unknown; connect the machine first</source>
        <translation>{name}: der Ort ist nicht bekannt; erst die Maschine verbinden</translation>
    </message>
    <message>
        <source>z-stack: {name} at {place}: must be {low} to {high}</source>
        <translation>Z-Stapel: {name} bei {place}: muss {low} bis {high} sein</translation>
    </message>
    <message>
        <source>this microscope has no focus motor; use an axis, or focus by hand</source>
        <translation>dieses Mikroskop hat keinen Fokustrieb; eine Achse verwenden oder von Hand fokussieren</translation>
    </message>
    <message>
        <source>{name} cannot focus here; available: {known}</source>
        <translation>{name} fokussiert hier nicht; möglich: {known}</translation>
    </message>
    <message>
        <source>Microscope: {error}</source>
        <extracomment>The run of each kind that is under way, or else the latest one.</extracomment>
        <translation>Mikroskop: {error}</translation>
    </message>
    <message>
        <source>axis {axis} does not move the tip; choose one of {joints}</source>
        <translation>Achse {axis} bewegt die Spitze nicht; möglich: {joints}</translation>
    </message>
    <message>
        <source>axis {axis}: the tip appears farther from the pivot than the pin is long; the calibration was made on another machine or at another position: calibrate again</source>
        <translation>Achse {axis}: die Spitze war weiter vom Drehpunkt entfernt, als der Stift lang ist; die Kalibrierung entstand an einer anderen Maschine oder Position: neu kalibrieren</translation>
    </message>
    <message>
        <source>the record already has a reference of axis {axis}; choose one of {names} without ref</source>
        <translation>die Aufzeichnung hat schon eine Referenz von Achse {axis}; sie braucht eine von {names} ohne deren ref</translation>
    </message>
    <message>
        <source>the record has no axis {axis}; choose one of {names} without ref</source>
        <translation>die Aufzeichnung hat keine Achse {axis}; sie braucht eine von {names} ohne deren ref</translation>
    </message>
    <message>
        <source>{count} frames show the tip, but no sample of the record lies between the first and the last of them; record frames and samples together, on one clock</source>
        <translation>{count} Bilder zeigen die Spitze, aber kein Messwert der Aufzeichnung liegt zwischen dem ersten und dem letzten; Bilder und Messwerte zusammen mit einer Uhr aufzeichnen</translation>
    </message>
    <message>
        <source>no move is planned; click in the picture first</source>
        <translation>keine Bewegung ist geplant; erst ins Bild klicken</translation>
    </message>
    <message>
        <source>the tip is lost: {reason}</source>
        <extracomment>The current visit, or the latest one.</extracomment>
        <translation>die Spitze ist verloren: {reason}</translation>
    </message>
    <message>
        <source>a click cannot move the tip: {error}</source>
        <translation>Ein Klick kann die Spitze nicht bewegen: {error}</translation>
    </message>
    <message>
        <source>the tip is not tracked; turn on tracking, so that the move can be checked</source>
        <translation>die Spitze wird nicht verfolgt; die Verfolgung einschalten, damit die Bewegung zu sehen ist</translation>
    </message>
    <message>
        <source>{path}: the last pictures could not be written within {timeout_s} s; {pictures} pictures are kept</source>
        <translation>{path}: die letzten Bilder konnten nicht innerhalb von {timeout_s} s geschrieben werden; {pictures} Bilder sind gespeichert</translation>
    </message>
    <message>
        <source>{path}: the video has ended ({why}); {kept} pictures are kept. Free disk space, or choose another folder, and start another one</source>
        <extracomment>The status; replaced as a whole.</extracomment>
        <translation>{path}: das Video ist zu Ende ({why}); {kept} Bilder bleiben. Platz schaffen oder einen anderen Ordner wählen und ein neues beginnen</translation>
    </message>
    <message>
        <source>{name}: pictures are missing in the video: the disk is too slow, or the camera&apos;s settings were changed. Use a smaller region, fewer pictures per second, or another disk; start another video after a change of settings</source>
        <translation>{name}: im Video fehlen Bilder: der Datenträger ist zu langsam, oder die Einstellungen der Kamera wurden geändert. Einen kleineren Ausschnitt, weniger Bilder je Sekunde oder einen anderen Datenträger verwenden; nach geänderten Einstellungen ein neues Video beginnen</translation>
    </message>
    <message>
        <source>{path}: the card cannot be stored ({strerror}); free disk space</source>
        <translation>{path}: die Karte kann nicht gespeichert werden ({strerror}); Platz schaffen</translation>
    </message>
    <message>
        <source>health card: the record has no {axis}.{tap}</source>
        <translation>Zustandskarte: die Aufzeichnung hat kein {axis}.{tap}</translation>
    </message>
    <message>
        <source>the fit of a second-order model is only {fit_percent} %</source>
        <translation>die Anpassung eines Modells zweiter Ordnung beträgt nur {fit_percent} %</translation>
    </message>
    <message>
        <source>{axis}.cmd is never held after a move</source>
        <translation>{axis}.cmd wird nach keiner Bewegung gehalten</translation>
    </message>
    <message>
        <source>{path}: the calibration belongs to axis {axis} of robot {robot}, not of {name}; calibrate this one</source>
        <translation>{path}: gehört zu Achse {axis} von Roboter {robot}, nicht von {name}; diese hier kalibrieren</translation>
    </message>
    <message>
        <source>{path}: unit = {unit}: axis {axis} has another unit</source>
        <translation>{path}: unit = {unit}: Achse {axis} hat eine andere Einheit</translation>
    </message>
    <message>
        <source>--set {text}: write it as name=value, such as baud=9600</source>
        <translation>--set {text}: als name=value schreiben, etwa baud=9600</translation>
    </message>
    <message>
        <source>driver {driver} has no setting {setting}; available: {known}</source>
        <translation>Treiber {driver} hat keine Einstellung {setting}; bekannt: {known}</translation>
    </message>
    <message>
        <source>{path} contains no table of preferences</source>
        <translation>{path}: enthält keine Tabelle mit Einstellungen</translation>
    </message>
    <message>
        <source>fault {strip}: unknown command; use {known}</source>
        <translation>fault {strip}: diesen Befehl gibt es nicht; möglich: {known}</translation>
    </message>
    <message>
        <source>fault {strip}: {error}</source>
        <translation>fault {strip}: {error}</translation>
    </message>
    <message>
        <source>{names} is not a stepper axis and has no steps</source>
        <translation>{names} ist keine Schrittmotorachse und hat keine Schritte</translation>
    </message>
    <message>
        <source>enter three readings, 0 to {most_reading}, then optionally buttons, 0 to {most_buttons}</source>
        <translation>drei Messwerte eingeben, 0 bis {most_reading}, danach wahlweise Tasten, 0 bis {most_buttons}</translation>
    </message>
    <message>
        <source>enter an axis: one of {names}</source>
        <translation>eine Achse eingeben: eine von {names}</translation>
    </message>
    <message>
        <source>{word} must be a number from 1 to {most}</source>
        <translation>{word} muss eine Zahl von 1 bis {most} sein</translation>
    </message>
    <message>
        <source>enter a time such as &apos;5 ms&apos; or &apos;2 s&apos;, at most {most_s} s</source>
        <translation>eine Zeit eingeben, etwa &apos;5 ms&apos; oder &apos;2 s&apos;, höchstens {most_s} s</translation>
    </message>
    <message>
        <source>{names} is not allowed here</source>
        <translation>{names} ist hier nicht erlaubt</translation>
    </message>
    <message>
        <source>baud {baud}: must be one of {names}</source>
        <translation>baud {baud}: muss eine von {names} sein</translation>
    </message>
    <message>
        <source>robot {name}: its {count} axes need only one board, which has one port; leave out the second one</source>
        <translation>Roboter {name}: seine {count} Achsen brauchen eine Karte, und die hat einen Anschluss; den zweiten weglassen</translation>
    </message>
    <message>
        <source>frame: address = {address}: must be 1 to {broadcast}</source>
        <translation>Rahmen: Adresse = {address}: muss 1 bis {broadcast} sein</translation>
    </message>
    <message>
        <source>frame: {name} = {value}: must be 0 to 255</source>
        <translation>Rahmen: {name} = {value}: muss 0 bis 255 sein</translation>
    </message>
    <message>
        <source>frame: a payload of {count} bytes: at most {max_payload}</source>
        <translation>Rahmen: Nutzdaten von {count} Byte: höchstens {max_payload}</translation>
    </message>
    <message>
        <source>frame of type 0x{type}: not a message of this protocol</source>
        <translation>Rahmen vom Typ 0x{type}: keine Nachricht dieses Protokolls</translation>
    </message>
    <message>
        <source>{what}: a number does not fit: {error}</source>
        <translation>{what}: eine Zahl passt nicht: {error}</translation>
    </message>
    <message>
        <source>{name}: a payload of {count} bytes: must be {size}{more}</source>
        <translation>{name}: Nutzdaten von {count} Byte: müssen {size}{more} sein</translation>
    </message>
    <message>
        <source>to report all parameters</source>
        <translation>um alle Parameter zu melden</translation>
    </message>
    <message>
        <source>board&apos;s program</source>
        <translation>Programm der Karte</translation>
    </message>
    <message>
        <source>program on this computer</source>
        <translation>Programm auf diesem Rechner</translation>
    </message>
    <message>
        <source>{where} uses version {version} of the protocol, this program {own}; update the {older}</source>
        <translation>{where} verwendet Version {version} des Protokolls, dieses Programm {own}; das {older} aktualisieren</translation>
    </message>
    <message>
        <source>{where} has {axes} axes, but robot {name} has {count} there ({names}); choose the robot file of this machine</source>
        <translation>{where} hat {axes} Achsen, Roboter {name} dort aber {count} ({names}); die Roboterdatei dieser Maschine wählen</translation>
    </message>
    <message>
        <source>to report its rates</source>
        <translation>um ihre Raten zu melden</translation>
    </message>
    <message>
        <source>{where} answers, but takes {trip}: on a shared bus this allows a sample every {sample} at best, but one every {limit} is needed. Use a faster connection, or a separate line for each board</source>
        <translation>{where} antwortet, braucht dafür aber {trip}: Auf einem gemeinsamen Bus ist damit bestenfalls alle {sample} ein Abtastwert möglich, nötig ist einer alle {limit}. Verwenden Sie eine schnellere Verbindung oder eine eigene Leitung für jede Karte</translation>
    </message>
    <message>
        <source>{where} answers, but takes {trip}: with watchdog_s = {watch} it would halt between two messages. Use a faster connection, or set watchdog_s to {least} or more; after a lost connection the axes keep moving for that time</source>
        <translation>{where} antwortet, braucht dafür aber {trip}: Mit watchdog_s = {watch} würde sie zwischen zwei Nachrichten anhalten. Verwenden Sie eine schnellere Verbindung, oder setzen Sie watchdog_s auf mindestens {least}; nach einem Verbindungsabbruch fahren die Achsen so lange weiter</translation>
    </message>
    <message>
        <source>to report its kind</source>
        <translation>um ihre Art zu melden</translation>
    </message>
    <message>
        <source>to describe its axes</source>
        <translation>um ihre Achsen zu beschreiben</translation>
    </message>
    <message>
        <source>{wrong}; choose the robot file of this machine</source>
        <translation>{wrong}; die Roboterdatei dieser Maschine wählen</translation>
    </message>
    <message>
        <source>{where}: {what} of axis {axis} is {told}, but {wanted} in the robot file</source>
        <translation>{where}: {what} von Achse {axis} ist {told}, laut Roboterdatei {wanted}</translation>
    </message>
    <message>
        <source>{where}: the step of axis {axis} is {step}, but {wanted} in the robot file</source>
        <translation>{where}: ein Schritt von Achse {axis} ist {step}, laut Roboterdatei {wanted}</translation>
    </message>
    <message>
        <source>to report its position</source>
        <translation>um ihre Position zu melden</translation>
    </message>
    <message>
        <source>to come to rest</source>
        <translation>um zur Ruhe zu kommen</translation>
    </message>
    <message>
        <source>to clear its fault</source>
        <translation>um ihren Fehler zu quittieren</translation>
    </message>
    <message>
        <source>to send telemetry</source>
        <translation>um Telemetrie zu senden</translation>
    </message>
    <message>
        <source>{where} reports no rate of telemetry or segments</source>
        <translation>{where} meldet keine Rate für Telemetrie oder Segmente</translation>
    </message>
    <message>
        <source>{where} reports {tick} ticks per second, but the {period_ms} ms between two samples must be a whole number of ticks</source>
        <translation>{where} meldet {tick} Takte je Sekunde, aber die {period_ms} ms zwischen zwei Abtastwerten müssen eine ganze Zahl von Takten sein</translation>
    </message>
    <message>
        <source>{where}: board {other} answers there instead; swap the cables, or the settings port and second_port</source>
        <translation>{where}: Stattdessen antwortet dort Karte {other}; vertauschen Sie die Kabel oder die Einstellungen port und second_port</translation>
    </message>
    <message>
        <source>{where}: this program receives its own frames ({count}), and no board answers; check the power of the board, and whether transmit and receive lines are connected to each other</source>
        <translation>{where}: Dieses Programm empfängt seine eigenen Telegramme ({count}), und keine Karte antwortet; prüfen Sie die Versorgung der Karte, und ob Sende- und Empfangsleitung miteinander verbunden sind</translation>
    </message>
    <message>
        <source>{who} took longer than {limit_s} s {what}; check cable and supply</source>
        <translation>{who}: brauchte länger als {limit_s} s, {what}; Kabel und Versorgung prüfen</translation>
    </message>
    <message>
        <source>{where} answers, but not in version {own} of the protocol, which this program uses; update the board&apos;s program</source>
        <translation>{where} antwortet, aber nicht in Version {own} des Protokolls, die dieses Programm verwendet; das Programm der Karte aktualisieren</translation>
    </message>
    <message>
        <source>{where}: {count} bytes arrive at {baud} baud, but no valid frame of a board; check the baud rate (others: {others}), and whether an MC68HC11 board is connected to this port</source>
        <translation>{where}: Bei {baud} Baud kommen {count} Bytes an, aber kein gültiges Telegramm einer Karte; Baudrate prüfen (andere: {others}) und ob eine MC68HC11-Karte an diesem Anschluss hängt</translation>
    </message>
    <message>
        <source>{where}: no answer at {baud} baud; check the power of the board, its cable (at this port, not the other board&apos;s), and the baud rate (others: {others})</source>
        <translation>{where}: keine Antwort bei {baud} Baud; die Versorgung der Karte, ihr Kabel (an diesem Anschluss, nicht an dem der anderen Karte) und die Baudrate prüfen (andere: {others})</translation>
    </message>
    <message>
        <source>low</source>
        <translation>unten</translation>
    </message>
    <message>
        <source>high</source>
        <translation>oben</translation>
    </message>
    <message>
        <source>stopped by a stop signal on the line that this program did not send; check the line</source>
        <translation>von einem Halt-Signal auf der Leitung angehalten, das dieses Programm nicht gesendet hat; prüfen Sie die Leitung</translation>
    </message>
    <message>
        <source>the host was silent for too long; the board halted</source>
        <translation>der Rechner schwieg zu lange; die Karte hat angehalten</translation>
    </message>
    <message>
        <source>a limit switch was reached</source>
        <translation>ein Endschalter wurde erreicht</translation>
    </message>
    <message>
        <source>an axis reached an end of its range</source>
        <translation>eine Achse erreichte ein Ende ihres Bereichs</translation>
    </message>
    <message>
        <source>a position sensor failed</source>
        <translation>ein Positionssensor ist ausgefallen</translation>
    </message>
    <message>
        <source>the supply voltage dropped; home it again</source>
        <translation>die Versorgungsspannung brach ein; neu referenzieren</translation>
    </message>
    <message>
        <source>the board was reset; home it again</source>
        <translation>die Karte wurde zurückgesetzt; neu referenzieren</translation>
    </message>
    <message>
        <source>a set-point came too late; the trajectory ended there</source>
        <translation>ein Sollwert kam zu spät; dort endete die Trajektorie</translation>
    </message>
    <message>
        <source>the profile could not be run</source>
        <translation>das Profil konnte nicht gefahren werden</translation>
    </message>
    <message>
        <source>a set-point was too far away for the axis to reach it in time; the set-point was refused</source>
        <translation>ein Sollwert war zu weit entfernt, um von der Achse rechtzeitig erreicht zu werden; der Sollwert wurde abgelehnt</translation>
    </message>
    <message>
        <source>board {address} on {url}</source>
        <extracomment>Check of the commands that telemetry reports; None while the connection is opened.</extracomment>
        <translation>Karte {address} an {url}</translation>
    </message>
    <message>
        <source>limit switch reached: {switches}</source>
        <translation>Endschalter erreicht: {switches}</translation>
    </message>
    <message>
        <source>board {address}: {words}</source>
        <translation>Karte {address}: {words}</translation>
    </message>
    <message>
        <source>{where}: {count} reports in a row show a position that its axes cannot have reached. Check the board, connect again, and home or confirm the position</source>
        <translation>{where}: {count} Meldungen in Folge nennen eine Position, an die ihre Achsen nicht gelangt sein können. Prüfen Sie die Karte, verbinden Sie neu, und referenzieren oder bestätigen Sie die Position</translation>
    </message>
    <message>
        <source>{name} {end}</source>
        <translation>{name} {end}</translation>
    </message>
    <message>
        <source>low limit</source>
        <translation>untere Grenze</translation>
    </message>
    <message>
        <source>high limit</source>
        <translation>obere Grenze</translation>
    </message>
    <message>
        <source>greatest speed</source>
        <translation>größte Geschwindigkeit</translation>
    </message>
    <message>
        <source>greatest acceleration</source>
        <translation>größte Beschleunigung</translation>
    </message>
    <message>
        <source>microsteps per revolution</source>
        <translation>Mikroschritte je Umdrehung</translation>
    </message>
    <message>
        <source>greatest slew rate of the converter</source>
        <translation>größte Anstiegsrate des Wandlers</translation>
    </message>
    <message>
        <source>homing speed</source>
        <translation>Geschwindigkeit beim Referenzieren</translation>
    </message>
    <message>
        <source>voltage at code 0</source>
        <translation>Spannung beim Code 0</translation>
    </message>
    <message>
        <source>voltage at the last code</source>
        <translation>Spannung beim letzten Code</translation>
    </message>
    <message>
        <source>{axis}: {parameter}</source>
        <translation>{axis}: {parameter}</translation>
    </message>
    <message>
        <source>{name}: robot {robot_name} has one board; leave second_port empty</source>
        <translation>{name}: Roboter {robot_name} hat eine Karte; second_port leer lassen</translation>
    </message>
    <message>
        <source>{name}: {lost}</source>
        <translation>{name}: {lost}</translation>
    </message>
    <message>
        <source>this program did not run for {seconds} s (limit {limit} s while axes move), so all motion was cancelled. Check the machine, clear the fault and move again</source>
        <extracomment>All motion is cancelled if this program does not run for a longer time. A busy computer causes shorter pauses. A suspended one causes much longer pauses, and meanwhile the machine may change.</extracomment>
        <translation>dieses Programm lief {seconds} s lang nicht (Grenze {limit} s, während Achsen fahren), daher wurden alle Bewegungen abgebrochen. Prüfen Sie die Maschine, quittieren Sie den Fehler, und fahren Sie erneut</translation>
    </message>
    <message>
        <source>{name}: setting {setting} = {value} is not between {least} and {greatest}</source>
        <translation>{name}: Einstellung {setting} = {value} liegt nicht zwischen {least} und {greatest}</translation>
    </message>
    <message>
        <source>a stop interrupted the writing</source>
        <translation>ein Halt brach das Schreiben ab</translation>
    </message>
    <message>
        <source>{name}: cannot {action} while its parameters are written; wait</source>
        <translation>{name}: {action} ist nicht möglich, während die Parameter geschrieben werden; warten</translation>
    </message>
    <message>
        <source>and {count} more</source>
        <translation>und {count} weitere</translation>
    </message>
    <message>
        <source>{name}: cannot {action}: the boards&apos; parameters differ from the robot file ({differences}); accept_parameters or write_parameters first</source>
        <translation>{name}: {action} ist nicht möglich: die Parameter der Karten weichen von der Roboterdatei ab ({differences}); erst accept_parameters oder write_parameters</translation>
    </message>
    <message>
        <source>board {address} did not store the written parameters</source>
        <translation>Karte {address} hat die geschriebenen Parameter nicht gespeichert</translation>
    </message>
    <message>
        <source>board {address} refused to set {what} (reason {reason})</source>
        <translation>Karte {address} nahm {what} nicht an (Grund {reason})</translation>
    </message>
    <message>
        <source>no serial port is set; set port to a device, for example /dev/ttyUSB0</source>
        <translation>kein serieller Anschluss eingestellt; port auf ein Gerät setzen, zum Beispiel /dev/ttyUSB0</translation>
    </message>
    <message>
        <source>{url}: the port takes no more bytes: {waiting} bytes have been waiting for {seconds} s. The device or its adapter may have hung. If the machine moves, use its emergency stop switch. Check cable, adapter and device, then reconnect</source>
        <translation>{url}: der Anschluss nimmt keine Bytes mehr an: {waiting} Byte warten seit {seconds} s. Das Gerät oder sein Adapter reagiert womöglich nicht mehr. Falls sich die Maschine bewegt, benutzen Sie ihren Not-Halt. Prüfen Sie Kabel, Adapter und Gerät, und verbinden Sie dann neu</translation>
    </message>
    <message>
        <source>{url}: no permission to open it; add the user to the group that owns the device (dialout on most systems) and log in again</source>
        <translation>{url}: keine Berechtigung zum Öffnen; den Benutzer in die Gruppe des Geräts aufnehmen (meist dialout) und neu anmelden</translation>
    </message>
    <message>
        <source>{url}: another program uses it; close that program</source>
        <translation>{url}: ein anderes Programm verwendet ihn; das andere Programm schließen</translation>
    </message>
    <message>
        <source>{url} cannot be opened: {said}</source>
        <translation>{url}: lässt sich nicht öffnen: {said}</translation>
    </message>
    <message>
        <source>telemetry: a reading of {reading} steps: 24 bits at most</source>
        <translation>Telemetrie: ein Messwert von {reading} Schritten: höchstens 24 Bit</translation>
    </message>
    <message>
        <source>telemetry: {count} bytes: must be {axis_bytes} per axis</source>
        <translation>Telemetrie: {count} Byte: müssen {axis_bytes} je Achse sein</translation>
    </message>
    <message>
        <source>inputs: a reading of {reading}: must be 0 to 4095</source>
        <translation>Eingänge: ein Messwert von {reading}: muss 0 bis 4095 sein</translation>
    </message>
    <message>
        <source>a motion was not sent: {error}</source>
        <translation>eine Bewegung wurde nicht gesendet: {error}</translation>
    </message>
    <message>
        <source>{where}: according to its parameters, the voltage of axis {axis} goes from {first} V to {last} V; write the parameters of the robot file to the board</source>
        <translation>{where}: nach ihren Parametern reicht die Spannung von Achse {axis} von {first} V bis {last} V; schreiben Sie die Parameter der Roboterdatei auf die Karte</translation>
    </message>
    <message>
        <source>{name}: {where} cannot play trajectories</source>
        <translation>{name}: {where} kann keine Trajektorien abspielen</translation>
    </message>
    <message>
        <source>it does not know this message</source>
        <translation>sie kennt die Nachricht nicht</translation>
    </message>
    <message>
        <source>it expects another length of this message</source>
        <translation>sie erwartet eine andere Länge dieser Nachricht</translation>
    </message>
    <message>
        <source>a value is outside the range that it accepts; compare its parameters</source>
        <translation>ein Wert liegt außerhalb des zulässigen Bereichs; ihre Parameter vergleichen</translation>
    </message>
    <message>
        <source>it is not homed</source>
        <translation>sie ist nicht referenziert</translation>
    </message>
    <message>
        <source>it is busy</source>
        <translation>sie ist beschäftigt</translation>
    </message>
    <message>
        <source>its queue is full</source>
        <translation>ihre Warteschlange ist voll</translation>
    </message>
    <message>
        <source>it cannot do this</source>
        <translation>sie kann das nicht</translation>
    </message>
    <message>
        <source>it came out of order</source>
        <translation>sie kam außer der Reihe</translation>
    </message>
    <message>
        <source>board {address} refused a motion: {why}; nothing more was sent to it</source>
        <translation>Karte {address} lehnte eine Bewegung ab: {why}; es wurde ihr nichts weiter gesendet</translation>
    </message>
    <message>
        <source>reason {number}</source>
        <translation>Grund {number}</translation>
    </message>
    <message>
        <source>{name}: {names} are not all on one board</source>
        <translation>{name}: {names} sind nicht alle auf einer Karte</translation>
    </message>
    <message>
        <source>{name}: capture at {rate_hz} Hz: must be at least {most_period_us} Hz</source>
        <translation>{name}: schnelle Aufzeichnung mit {rate_hz} Hz: mindestens {most_period_us} Hz</translation>
    </message>
    <message>
        <source>{name}: {where} cannot run profiles</source>
        <translation>{name}: {where} kann keine Profile fahren</translation>
    </message>
    <message>
        <source>{name}: there is no profile to run; upload one first</source>
        <translation>{name}: es gibt kein Profil zu fahren; erst eines hochladen</translation>
    </message>
    <message>
        <source>{name}: no board has a display</source>
        <translation>{name}: keine Karte hat eine Anzeige</translation>
    </message>
    <message>
        <source>axis {name} did not reach the trajectory&apos;s first row</source>
        <translation>Achse {name} erreichte die erste Zeile der Trajektorie nicht</translation>
    </message>
    <message>
        <source>board {address} refused to begin the trajectory ({reason})</source>
        <translation>Karte {address} wollte die Trajektorie nicht beginnen ({reason})</translation>
    </message>
    <message>
        <source>board {address} refused a set-point ({refusal})</source>
        <translation>Karte {address} lehnte einen Sollwert ab ({refusal})</translation>
    </message>
    <message>
        <source>axis {axis}: the set-points around t = {time} s are {value} apart, more than the limit {bound} in {period}; add a row every {period}, or stretch the trajectory&apos;s time by a factor of {factor} or more</source>
        <translation>Achse {axis}: die Sollwerte um t = {time} s liegen {value} auseinander, mehr als die Grenze von {bound} in {period}; fügen Sie alle {period} eine Zeile ein, oder strecken Sie die Zeit der Trajektorie mindestens auf das {factor}-Fache</translation>
    </message>
    <message>
        <source>{where} takes {trip} to answer, but a set-point every {period} needs an answer within {limit}; use a faster connection to play trajectories</source>
        <translation>{where} braucht {trip} für eine Antwort, ein Sollwert alle {period} verlangt aber eine Antwort innerhalb von {limit}; verwenden Sie zum Abspielen von Trajektorien eine schnellere Verbindung</translation>
    </message>
    <message>
        <source>robot {robot}: axis {axis} is moved by a {kind}; the MC68HC11 boards move stepping motors and piezos</source>
        <translation>Roboter {robot}: Achse {axis} wird von {kind} bewegt; die MC68HC11-Karten bewegen Schrittmotoren und Piezos</translation>
    </message>
    <message>
        <source>robot {name}: {count} axes: two boards have {axes} at most</source>
        <translation>Roboter {name}: {count} Achsen: zwei Karten haben höchstens {axes}</translation>
    </message>
    <message>
        <source>a step of {size}: its power of ten takes more than 8 bits</source>
        <translation>ein Schritt von {size}: seine Zehnerpotenz braucht mehr als 8 Bit</translation>
    </message>
    <message>
        <source>{name}: cannot change a compensation while it is {state}; stop it or wait</source>
        <translation>{name}: eine Kompensation lässt sich nicht ändern, während der Zustand {state} ist; anhalten oder warten</translation>
    </message>
    <message>
        <source>{name}: the inverse is for axis {axis}, not for {other}</source>
        <translation>{name}: die Inverse ist für Achse {axis}, nicht für {other}</translation>
    </message>
    <message>
        <source>{name}: cannot change a loop while it is {state}; stop it or wait</source>
        <translation>{name}: ein Regelkreis lässt sich nicht ändern, während der Zustand {state} ist; anhalten oder warten</translation>
    </message>
    <message>
        <source>{name}: the loop is for axis {axis}, not for {other}</source>
        <translation>{name}: der Regelkreis ist für Achse {axis}, nicht für {other}</translation>
    </message>
    <message>
        <source>{name}: axis {axis}: the loop was checked for stability on robot {robot_name}, whose axis is different; check it on this robot</source>
        <translation>{name}: Achse {axis}: die Stabilität des Regelkreises wurde an Roboter {robot_name} geprüft, dessen Achse anders ist; prüfen Sie ihn an diesem Roboter</translation>
    </message>
    <message>
        <source>samples: arrays of shapes {shapes} for {count} times</source>
        <translation>Abtastwerte: Felder der Formen {shapes} für {count} Zeiten</translation>
    </message>
    <message>
        <source>samples: {rows} rows for {times} times</source>
        <translation>Abtastwerte: {rows} Zeilen für {times} Zeiten</translation>
    </message>
    <message>
        <source>samples: the device&apos;s time does not increase</source>
        <translation>Abtastwerte: die Zeit des Geräts nimmt nicht zu</translation>
    </message>
    <message>
        <source>samples: a command or reading is not a finite number</source>
        <translation>Abtastwerte: ein Sollwert oder Messwert ist keine endliche Zahl</translation>
    </message>
    <message>
        <source>{name} is closed; open it first</source>
        <translation>{name}: geschlossen; erst öffnen</translation>
    </message>
    <message>
        <source>{name} is free-running; configure a software trigger first</source>
        <translation>{name}: läuft frei; erst einen Software-Trigger einstellen</translation>
    </message>
    <message>
        <source>{name}: a picture of {columns} × {rows} px, expected {width} × {height}. The resolution has changed: close the camera, open it again, and repeat the calibration</source>
        <translation>{name}: ein Bild von {columns} × {rows} px, erwartet {width} × {height}. Die Auflösung hat sich geändert: schließen Sie die Kamera, öffnen Sie sie erneut, und wiederholen Sie die Kalibrierung</translation>
    </message>
    <message>
        <source>{name}: a picture of type {found}, expected {expected}. The pixel type has changed: close the camera and open it again</source>
        <translation>{name}: ein Bild vom Typ {found}, erwartet {expected}. Der Pixeltyp hat sich geändert: schließen Sie die Kamera, und öffnen Sie sie erneut</translation>
    </message>
    <message>
        <source>{name} gives empty or unusable pictures (pixels: {dtype}, size: {size}); check the camera and its cable, and open it again</source>
        <translation>{name} liefert leere oder unbrauchbare Bilder (Pixel: {dtype}, Größe: {size}); prüfen Sie Kamera und Kabel, und öffnen Sie sie erneut</translation>
    </message>
    <message>
        <source>Simulated microscope</source>
        <translation>Simuliertes Mikroskop</translation>
    </message>
    <message>
        <source>{name} shows only a simulated machine; connect the simulator</source>
        <translation>{name} zeigt nur eine simulierte Maschine; den Simulator verbinden</translation>
    </message>
    <message>
        <source>{name}: focus at {focus_m} µm: must be {low} to {high} µm</source>
        <translation>{name}: Fokus bei {focus_m} µm: muss {low} bis {high} µm sein</translation>
    </message>
    <message>
        <source>{name} was opened for another robot than {robot_name}, which is now in use; close it and open it again</source>
        <translation>{name} wurde für einen anderen Roboter als {robot_name} geöffnet, der jetzt verwendet wird; schließen Sie es und öffnen Sie es erneut</translation>
    </message>
    <message>
        <source>USB camera, video file or stream</source>
        <translation>USB-Kamera, Videodatei oder Datenstrom</translation>
    </message>
    <message>
        <source>number of a device, path of a video file, or address such as rtsp://…</source>
        <translation>Nummer eines Geräts, Pfad einer Videodatei oder Adresse wie rtsp://…</translation>
    </message>
    <message>
        <source>{name}: no address; enter a {address_hint}</source>
        <translation>{name}: keine Adresse; bitte eingeben: {address_hint}</translation>
    </message>
    <message>
        <source>{name} delivers no pictures; check that it is connected, and open it again</source>
        <translation>{name} liefert keine Bilder; prüfen Sie, ob sie angeschlossen ist, und öffnen Sie sie erneut</translation>
    </message>
    <message>
        <source>{name}: there is no camera {address}, or another program uses it, or you have no permission (group &apos;video&apos; on Linux)</source>
        <translation>{name}: die Kamera {address} gibt es nicht, ein anderes Programm verwendet sie, oder sie darf nicht gelesen werden (Gruppe &apos;video&apos; unter Linux)</translation>
    </message>
    <message>
        <source>a manual exposure</source>
        <translation>manuelle Belichtung</translation>
    </message>
    <message>
        <source>an exposure of {exposure_s} s</source>
        <translation>eine Belichtung von {exposure_s} s</translation>
    </message>
    <message>
        <source>a gain of {gain}</source>
        <translation>eine Verstärkung von {gain}</translation>
    </message>
    <message>
        <source>{name} does not accept {what}; leave it unchanged</source>
        <translation>{name} nimmt {what} nicht an; unverändert lassen</translation>
    </message>
    <message>
        <source>{address}: file not found; choose another one</source>
        <translation>{address}: diese Datei gibt es nicht; eine andere wählen</translation>
    </message>
    <message>
        <source>{address}: not a video, or a truncated one, or an unknown format; choose another file</source>
        <translation>{address}: kein Video, ein unvollständiges oder eines in einem unbekannten Format; wählen Sie eine andere Datei</translation>
    </message>
    <message>
        <source>{address}: no video arrived within {timeout_s} s; check the address and the network</source>
        <translation>{address}: von dort kam in {timeout_s} s kein Video; Adresse und Netz prüfen</translation>
    </message>
    <message>
        <source>it is not a video: it has no pictures</source>
        <translation>es ist kein Video: es enthält keine Bilder</translation>
    </message>
    <message>
        <source>it is a text file, not a video</source>
        <translation>es ist eine Textdatei, kein Video</translation>
    </message>
    <message>
        <source>it is a single picture, not a video; open pictures as an image sequence</source>
        <translation>es ist ein einzelnes Bild, kein Video; Bilder als Bildfolge öffnen</translation>
    </message>
    <message>
        <source>{address}: {reason}; choose another file</source>
        <translation>{address}: {reason}; eine andere Datei wählen</translation>
    </message>
    <message>
        <source>{name} has ended; open it again, or let it repeat</source>
        <translation>{name}: zu Ende; wieder öffnen oder wiederholen lassen</translation>
    </message>
    <message>
        <source>{name} has no pixel type {pixel_type}; available: {known}</source>
        <translation>{name}: Pixeltyp {pixel_type}: möglich: {known}</translation>
    </message>
    <message>
        <source>{name} has no trigger {trigger}; available: {known}</source>
        <translation>{name}: Trigger {trigger}: möglich: {known}</translation>
    </message>
    <message>
        <source>{name}: {what} = {value}{unit}: cannot be set; leave it unchanged</source>
        <translation>{name}: {what} = {value}{unit}: nicht einstellbar; unverändert lassen</translation>
    </message>
    <message>
        <source>{name}: {what} = {value}{unit}: must be {least} to {most}{unit}</source>
        <translation>{name}: {what} = {value}{unit}: muss zwischen {least} und {most}{unit} liegen</translation>
    </message>
    <message>
        <source>{name}: region of {width} × {height} px from column {left}, row {top}: must lie within the sensor&apos;s {can_width} × {can_height} px</source>
        <translation>{name}: Ausschnitt von {width} × {height} px ab Spalte {left}, Zeile {top}: muss innerhalb der {can_width} × {can_height} px des Sensors liegen</translation>
    </message>
    <message>
        <source>Image sequence</source>
        <translation>Bildfolge</translation>
    </message>
    <message>
        <source>folder of TIFF or PNG files, or TIFF file with several pages</source>
        <translation>Ordner mit TIFF- oder PNG-Dateien oder TIFF-Datei mit mehreren Seiten</translation>
    </message>
    <message>
        <source>{name} has ended after {count} pictures; open it again, or let it repeat</source>
        <translation>{name}: nach {count} Bildern zu Ende; wieder öffnen oder wiederholen lassen</translation>
    </message>
    <message>
        <source>{file}: a picture of type {pixel_type_of}, but the first one has type {pixel_types}; convert it</source>
        <translation>{file}: ein Bild vom Typ {pixel_type_of}, aber das erste hat den Typ {pixel_types}; wandeln Sie es um</translation>
    </message>
    <message>
        <source>{path}: there is no TIFF or PNG file in this folder; choose another one</source>
        <translation>{path}: in diesem Ordner ist keine TIFF- oder PNG-Datei; einen anderen wählen</translation>
    </message>
    <message>
        <source>{path}: folder or file not found; choose another one</source>
        <translation>{path}: diesen Ordner oder diese Datei gibt es nicht; eine andere Angabe wählen</translation>
    </message>
    <message>
        <source>the file is truncated or missing</source>
        <translation>die Datei ist abgeschnitten oder fehlt</translation>
    </message>
    <message>
        <source>{file}: page {page} cannot be read; the file is truncated or missing</source>
        <translation>{file}: Seite {page} kann nicht gelesen werden; die Datei ist abgeschnitten oder fehlt</translation>
    </message>
    <message>
        <source>{file}: pixels of type {dtype} with {ndim} dimensions: must be 8-bit or 16-bit grey, or 8-bit colour; convert it</source>
        <translation>{file}: Bildpunkte vom Typ {dtype} mit {ndim} Dimensionen: müssen Grau mit 8 oder 16 Bit oder Farbe mit 8 Bit sein; wandeln Sie die Datei um</translation>
    </message>
    <message>
        <source>{where}: the controller&apos;s reports have no machine position; send it $10=1</source>
        <translation>{where}: in den Meldungen der Steuerung fehlt die Maschinenposition; senden Sie ihr $10=1</translation>
    </message>
    <message>
        <source>{where}: the controller reports inches; send it $13=0</source>
        <translation>{where}: die Steuerung meldet Zoll; senden Sie ihr $13=0</translation>
    </message>
    <message>
        <source>{where}: an answer takes {took} s, but at most {most} s is allowed, since a stop takes half of that. Use a faster line</source>
        <translation>{where}: eine Antwort braucht {took} s; zulässig sind höchstens {most} s, denn ein Halt braucht die Hälfte davon. Verwenden Sie eine schnellere Leitung</translation>
    </message>
    <message>
        <source>did not reset</source>
        <extracomment>A line with a longer round trip is refused, because a stop would arrive too late.</extracomment>
        <translation>setzte sich nicht zurück</translation>
    </message>
    <message>
        <source>{where}: the axes still move {rest_s} s after a feed hold; use the machine&apos;s emergency stop switch</source>
        <translation>{where}: die Achsen bewegen sich {rest_s} s nach einem Vorschubhalt noch; den Not-Halt der Maschine benutzen</translation>
    </message>
    <message>
        <source>{where}: no answer to &apos;?&apos; within {limit_s} s: {why}</source>
        <translation>{where}: keine Antwort auf &apos;?&apos; innerhalb von {limit_s} s: {why}</translation>
    </message>
    <message>
        <source>{where}: the controller {what} within {limit_s} s</source>
        <translation>{where}: die Steuerung {what} innerhalb von {limit_s} s</translation>
    </message>
    <message>
        <source>did not answer {line}</source>
        <translation>beantwortete {line} nicht</translation>
    </message>
    <message>
        <source>a word does not begin with a letter</source>
        <translation>ein Wort beginnt nicht mit einem Buchstaben</translation>
    </message>
    <message>
        <source>a number is missing or malformed</source>
        <translation>eine Zahl fehlt oder ist fehlerhaft</translation>
    </message>
    <message>
        <source>a number must not be negative</source>
        <translation>eine Zahl darf nicht negativ sein</translation>
    </message>
    <message>
        <source>homing is not enabled; set $22</source>
        <translation>die Referenzfahrt ist nicht freigegeben; $22 setzen</translation>
    </message>
    <message>
        <source>the step pulse is too short</source>
        <translation>der Schrittimpuls ist zu kurz</translation>
    </message>
    <message>
        <source>soft limits need homing; set $22</source>
        <translation>Software-Grenzen brauchen die Referenzfahrt; $22 setzen</translation>
    </message>
    <message>
        <source>the safety door is open</source>
        <translation>die Schutztür ist offen</translation>
    </message>
    <message>
        <source>a stored line is too long</source>
        <translation>eine gespeicherte Zeile ist zu lang</translation>
    </message>
    <message>
        <source>laser mode needs a spindle output with PWM</source>
        <translation>der Laserbetrieb braucht einen Spindelausgang mit PWM</translation>
    </message>
    <message>
        <source>the feed rate is missing</source>
        <translation>der Vorschub fehlt</translation>
    </message>
    <message>
        <source>a G-code needs a whole number</source>
        <translation>ein G-Code braucht eine ganze Zahl</translation>
    </message>
    <message>
        <source>axis words are missing</source>
        <translation>Achswörter fehlen</translation>
    </message>
    <message>
        <source>the line number is not valid</source>
        <translation>die Zeilennummer ist ungültig</translation>
    </message>
    <message>
        <source>a G-code lacks a value</source>
        <translation>einem G-Code fehlt ein Wert</translation>
    </message>
    <message>
        <source>G53 needs G0 or G1</source>
        <translation>G53 braucht G0 oder G1</translation>
    </message>
    <message>
        <source>the target of the motion is not valid</source>
        <translation>das Ziel der Bewegung ist ungültig</translation>
    </message>
    <message>
        <source>the radius of the arc is not valid</source>
        <translation>der Radius des Kreisbogens ist ungültig</translation>
    </message>
    <message>
        <source>an arc needs an offset in its plane</source>
        <translation>ein Kreisbogen braucht einen Versatz in seiner Ebene</translation>
    </message>
    <message>
        <source>the tool length offset is for another axis</source>
        <translation>die Werkzeuglängenkorrektur gilt für eine andere Achse</translation>
    </message>
    <message>
        <source>the tool number is too large</source>
        <translation>die Werkzeugnummer ist zu groß</translation>
    </message>
    <message>
        <source>homing is not configured; set $22</source>
        <translation>die Referenzfahrt ist nicht eingerichtet; $22 setzen</translation>
    </message>
    <message>
        <source>a number must be greater than zero</source>
        <translation>eine Zahl muss größer als null sein</translation>
    </message>
    <message>
        <source>the tool number is too large, or no tool is selected</source>
        <translation>die Werkzeugnummer ist zu groß, oder kein Werkzeug ist gewählt</translation>
    </message>
    <message>
        <source>a value is out of range</source>
        <translation>ein Wert liegt außerhalb seines Bereichs</translation>
    </message>
    <message>
        <source>a tool change is pending</source>
        <translation>ein Werkzeugwechsel steht aus</translation>
    </message>
    <message>
        <source>the spindle does not turn</source>
        <translation>die Spindel dreht sich nicht</translation>
    </message>
    <message>
        <source>the plane must be ZX</source>
        <translation>die Ebene muss ZX sein</translation>
    </message>
    <message>
        <source>the feed rate is too high</source>
        <translation>der Vorschub ist zu hoch</translation>
    </message>
    <message>
        <source>the spindle speed is out of range</source>
        <translation>die Spindeldrehzahl liegt außerhalb ihres Bereichs</translation>
    </message>
    <message>
        <source>a limit switch is pressed; only homing is possible</source>
        <translation>ein Endschalter ist betätigt; nur die Referenzfahrt ist möglich</translation>
    </message>
    <message>
        <source>no tool is set</source>
        <translation>kein Werkzeug ist gesetzt</translation>
    </message>
    <message>
        <source>two words of the line contradict each other</source>
        <translation>zwei Wörter der Zeile widersprechen einander</translation>
    </message>
    <message>
        <source>a motor reports a fault</source>
        <translation>ein Motor meldet einen Fehler</translation>
    </message>
    <message>
        <source>the setting is out of range</source>
        <translation>die Einstellung liegt außerhalb ihres Bereichs</translation>
    </message>
    <message>
        <source>unknown command</source>
        <translation>unbekannter Befehl</translation>
    </message>
    <message>
        <source>the stored settings could not be read; check the defaults that are used</source>
        <translation>die gespeicherten Einstellungen waren nicht lesbar; prüfen Sie die verwendeten Vorgaben</translation>
    </message>
    <message>
        <source>the controller is not idle</source>
        <translation>die Steuerung ist nicht in Ruhe</translation>
    </message>
    <message>
        <source>the controller is locked by an alarm or busy with a jog</source>
        <translation>die Steuerung ist durch einen Alarm gesperrt oder führt gerade eine Tippbewegung aus</translation>
    </message>
    <message>
        <source>the line is too long</source>
        <translation>die Zeile ist zu lang</translation>
    </message>
    <message>
        <source>the step rate is too high for the controller</source>
        <translation>die Schrittrate ist zu hoch für die Steuerung</translation>
    </message>
    <message>
        <source>not a valid jog command</source>
        <translation>kein gültiger Tippbefehl</translation>
    </message>
    <message>
        <source>unsupported G-code</source>
        <translation>nicht unterstützter G-Code</translation>
    </message>
    <message>
        <source>two G-codes of the same group are in one line</source>
        <translation>zwei G-Codes derselben Gruppe stehen in einer Zeile</translation>
    </message>
    <message>
        <source>two G-codes in one line both need axis words</source>
        <translation>zwei G-Codes in einer Zeile brauchen beide Achswörter</translation>
    </message>
    <message>
        <source>a word appears twice in a line</source>
        <translation>ein Wort kommt in einer Zeile zweimal vor</translation>
    </message>
    <message>
        <source>this work coordinate system does not exist</source>
        <translation>dieses Werkstückkoordinatensystem gibt es nicht</translation>
    </message>
    <message>
        <source>the line has axis words but does not use them</source>
        <translation>die Zeile enthält Achswörter, verwendet sie aber nicht</translation>
    </message>
    <message>
        <source>an arc needs an axis word in its plane</source>
        <translation>ein Kreisbogen braucht ein Achswort seiner Ebene</translation>
    </message>
    <message>
        <source>the line has unused words</source>
        <translation>die Zeile enthält unbenutzte Wörter</translation>
    </message>
    <message>
        <source>the controller was reset</source>
        <translation>die Steuerung wurde zurückgesetzt</translation>
    </message>
    <message>
        <source>home all axes first</source>
        <translation>erst alle Achsen referenzieren</translation>
    </message>
    <message>
        <source>the self-test failed; switch the controller off and on</source>
        <translation>der Selbsttest schlug fehl; schalten Sie die Steuerung aus und wieder ein</translation>
    </message>
    <message>
        <source>the emergency stop is pressed</source>
        <translation>der Not-Halt ist gedrückt</translation>
    </message>
    <message>
        <source>this setting does not exist</source>
        <translation>diese Einstellung gibt es nicht</translation>
    </message>
    <message>
        <source>the retract position lies below the depth</source>
        <translation>die Rückzugsposition liegt unter der Tiefe</translation>
    </message>
    <message>
        <source>two axes with two motors each cannot be homed together</source>
        <translation>zwei Achsen mit je zwei Motoren lassen sich nicht zusammen referenzieren</translation>
    </message>
    <message>
        <source>the coordinate system is locked</source>
        <translation>das Koordinatensystem ist gesperrt</translation>
    </message>
    <message>
        <source>a file ends in an unexpected place</source>
        <translation>eine Datei endet an unerwarteter Stelle</translation>
    </message>
    <message>
        <source>the port does not exist</source>
        <translation>den Anschluss gibt es nicht</translation>
    </message>
    <message>
        <source>the SD card cannot be mounted</source>
        <translation>die SD-Karte lässt sich nicht einbinden</translation>
    </message>
    <message>
        <source>a file cannot be read</source>
        <translation>eine Datei lässt sich nicht lesen</translation>
    </message>
    <message>
        <source>a folder cannot be opened</source>
        <translation>ein Ordner lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>there is no such folder</source>
        <translation>diesen Ordner gibt es nicht</translation>
    </message>
    <message>
        <source>there is no SD card</source>
        <translation>es ist keine SD-Karte vorhanden</translation>
    </message>
    <message>
        <source>the file system is not mounted</source>
        <translation>das Dateisystem ist nicht eingebunden</translation>
    </message>
    <message>
        <source>the file system is read-only</source>
        <translation>das Dateisystem ist schreibgeschützt</translation>
    </message>
    <message>
        <source>Bluetooth cannot be started</source>
        <translation>Bluetooth lässt sich nicht starten</translation>
    </message>
    <message>
        <source>an expression has an unknown operator</source>
        <translation>ein Ausdruck hat einen unbekannten Operator</translation>
    </message>
    <message>
        <source>an expression divides by zero</source>
        <translation>ein Ausdruck teilt durch null</translation>
    </message>
    <message>
        <source>an argument of an expression is out of range</source>
        <translation>ein Argument eines Ausdrucks liegt außerhalb seines Bereichs</translation>
    </message>
    <message>
        <source>an argument of an expression is not valid</source>
        <translation>ein Argument eines Ausdrucks ist ungültig</translation>
    </message>
    <message>
        <source>the syntax of an expression is wrong</source>
        <translation>die Syntax eines Ausdrucks ist falsch</translation>
    </message>
    <message>
        <source>an expression has no finite result</source>
        <translation>ein Ausdruck hat kein endliches Ergebnis</translation>
    </message>
    <message>
        <source>a password is needed</source>
        <translation>ein Passwort ist nötig</translation>
    </message>
    <message>
        <source>access is denied</source>
        <translation>der Zugriff wird verweigert</translation>
    </message>
    <message>
        <source>flow commands are nested too deeply</source>
        <translation>Ablaufbefehle sind zu tief verschachtelt</translation>
    </message>
    <message>
        <source>a file cannot be opened</source>
        <translation>eine Datei lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>the file system cannot be formatted</source>
        <translation>das Dateisystem lässt sich nicht formatieren</translation>
    </message>
    <message>
        <source>the port cannot be used for this</source>
        <translation>der Anschluss ist dafür nicht verwendbar</translation>
    </message>
    <message>
        <source>a tool is in the spindle</source>
        <translation>ein Werkzeug ist in der Spindel</translation>
    </message>
    <message>
        <source>no tool is in the spindle</source>
        <translation>kein Werkzeug ist in der Spindel</translation>
    </message>
    <message>
        <source>a file cannot be deleted</source>
        <translation>eine Datei lässt sich nicht löschen</translation>
    </message>
    <message>
        <source>cutter compensation is already active</source>
        <translation>die Werkzeugradiuskorrektur ist schon aktiv</translation>
    </message>
    <message>
        <source>this is not possible during cutter compensation</source>
        <translation>das ist während der Werkzeugradiuskorrektur nicht möglich</translation>
    </message>
    <message>
        <source>cutter compensation does not fit this motion</source>
        <translation>die Werkzeugradiuskorrektur passt nicht zu dieser Bewegung</translation>
    </message>
    <message>
        <source>this setting is disabled</source>
        <translation>diese Einstellung ist abgeschaltet</translation>
    </message>
    <message>
        <source>no homing cycle is configured</source>
        <translation>kein Referenzzyklus ist eingerichtet</translation>
    </message>
    <message>
        <source>this axis cannot be homed alone</source>
        <translation>diese Achse lässt sich nicht allein referenzieren</translation>
    </message>
    <message>
        <source>a value is too large</source>
        <translation>ein Wert ist zu groß</translation>
    </message>
    <message>
        <source>a P value is too large</source>
        <translation>ein P-Wert ist zu groß</translation>
    </message>
    <message>
        <source>an input was active at start; check switches and buttons</source>
        <translation>ein Eingang war beim Start aktiv; Schalter und Taster prüfen</translation>
    </message>
    <message>
        <source>the storage cannot be mounted</source>
        <translation>der Datenspeicher lässt sich nicht einbinden</translation>
    </message>
    <message>
        <source>reading failed</source>
        <translation>das Lesen schlug fehl</translation>
    </message>
    <message>
        <source>a file is empty</source>
        <translation>eine Datei ist leer</translation>
    </message>
    <message>
        <source>there is no such file</source>
        <translation>diese Datei gibt es nicht</translation>
    </message>
    <message>
        <source>the storage is busy</source>
        <translation>der Datenspeicher ist belegt</translation>
    </message>
    <message>
        <source>a folder cannot be deleted</source>
        <translation>ein Ordner lässt sich nicht löschen</translation>
    </message>
    <message>
        <source>a file cannot be renamed</source>
        <translation>eine Datei lässt sich nicht umbenennen</translation>
    </message>
    <message>
        <source>the number is out of range for this setting</source>
        <translation>die Zahl liegt außerhalb des Bereichs dieser Einstellung</translation>
    </message>
    <message>
        <source>the value is not valid for this setting</source>
        <translation>der Wert ist für diese Einstellung ungültig</translation>
    </message>
    <message>
        <source>a file cannot be created</source>
        <translation>eine Datei lässt sich nicht anlegen</translation>
    </message>
    <message>
        <source>a message could not be sent</source>
        <translation>eine Nachricht ließ sich nicht senden</translation>
    </message>
    <message>
        <source>a setting could not be stored</source>
        <translation>eine Einstellung ließ sich nicht speichern</translation>
    </message>
    <message>
        <source>the password is wrong</source>
        <translation>das Passwort ist falsch</translation>
    </message>
    <message>
        <source>a line ends unexpectedly</source>
        <translation>eine Zeile endet unerwartet</translation>
    </message>
    <message>
        <source>a file ends unexpectedly</source>
        <translation>eine Datei endet unerwartet</translation>
    </message>
    <message>
        <source>no data arrived</source>
        <translation>es kamen keine Daten an</translation>
    </message>
    <message>
        <source>the jog was cancelled</source>
        <translation>die Tippbewegung wurde abgebrochen</translation>
    </message>
    <message>
        <source>an upload failed</source>
        <translation>ein Hochladen schlug fehl</translation>
    </message>
    <message>
        <source>a download failed</source>
        <translation>ein Herunterladen schlug fehl</translation>
    </message>
    <message>
        <source>this setting is read-only</source>
        <translation>diese Einstellung ist schreibgeschützt</translation>
    </message>
    <message>
        <source>a parameter cannot be set</source>
        <translation>ein Parameter lässt sich nicht setzen</translation>
    </message>
    <message>
        <source>the value of a word is not valid</source>
        <translation>der Wert eines Worts ist ungültig</translation>
    </message>
    <message>
        <source>hard limit: a limit switch was reached</source>
        <translation>Hardware-Grenze: ein Endschalter wurde erreicht</translation>
    </message>
    <message>
        <source>soft limit: a target lies beyond the travel</source>
        <translation>Software-Grenze: ein Ziel liegt außerhalb des Verfahrwegs</translation>
    </message>
    <message>
        <source>homing was ended by a reset</source>
        <translation>ein Zurücksetzen beendete die Referenzfahrt</translation>
    </message>
    <message>
        <source>the door was opened during homing</source>
        <translation>die Tür wurde bei der Referenzfahrt geöffnet</translation>
    </message>
    <message>
        <source>homing: the limit switch was not found</source>
        <translation>Referenzfahrt: der Endschalter wurde nicht gefunden</translation>
    </message>
    <message>
        <source>homing: the second limit switch of an axis with two motors was not found</source>
        <translation>Referenzfahrt: der zweite Endschalter einer Achse mit zwei Motoren wurde nicht gefunden</translation>
    </message>
    <message>
        <source>a limit switch is pressed; free the axis first</source>
        <translation>ein Endschalter ist betätigt; erst die Achse freifahren</translation>
    </message>
    <message>
        <source>the probe is in contact; free it first</source>
        <translation>der Messtaster hat Kontakt; ihn erst lösen</translation>
    </message>
    <message>
        <source>the spindle did not reach its speed</source>
        <translation>die Spindel erreichte ihre Drehzahl nicht</translation>
    </message>
    <message>
        <source>a Modbus device does not answer</source>
        <translation>ein Modbus-Gerät antwortet nicht</translation>
    </message>
    <message>
        <source>an input/output expander does not answer</source>
        <translation>eine Ein-/Ausgabe-Erweiterung antwortet nicht</translation>
    </message>
    <message>
        <source>homing: both ends of an axis report a limit switch</source>
        <translation>Referenzfahrt: beide Enden einer Achse melden einen Endschalter</translation>
    </message>
    <message>
        <source>an input/output expander was reset</source>
        <translation>eine Ein-/Ausgabe-Erweiterung wurde zurückgesetzt</translation>
    </message>
    <message>
        <source>a limit switch was reached while probing</source>
        <translation>beim Antasten wurde ein Endschalter erreicht</translation>
    </message>
    <message>
        <source>the target lies beyond the travel</source>
        <translation>das Ziel liegt außerhalb des Verfahrwegs</translation>
    </message>
    <message>
        <source>the controller is locked by a critical event; reset it</source>
        <translation>die Steuerung ist durch ein kritisches Ereignis gesperrt; setzen Sie sie zurück</translation>
    </message>
    <message>
        <source>a flow command is outside a macro</source>
        <translation>ein Ablaufbefehl steht außerhalb eines Makros</translation>
    </message>
    <message>
        <source>unknown flow command</source>
        <translation>unbekannter Ablaufbefehl</translation>
    </message>
    <message>
        <source>the memory is full</source>
        <translation>der Speicher ist voll</translation>
    </message>
    <message>
        <source>an error defined by the controller&apos;s maker or user</source>
        <translation>ein Fehler, den der Hersteller oder Benutzer der Steuerung festgelegt hat</translation>
    </message>
    <message>
        <source>the settings storage does not respond</source>
        <translation>der Speicher für Einstellungen antwortet nicht</translation>
    </message>
    <message>
        <source>another program or interface uses the controller</source>
        <translation>ein anderes Programm oder eine andere Schnittstelle verwendet die Steuerung</translation>
    </message>
    <message>
        <source>a pin is configured incorrectly</source>
        <translation>ein Pin ist falsch konfiguriert</translation>
    </message>
    <message>
        <source>a setting in the configuration is not valid</source>
        <translation>eine Einstellung in der Konfiguration ist ungültig</translation>
    </message>
    <message>
        <source>the configuration file is not valid; read the start-up messages</source>
        <translation>die Konfigurationsdatei ist ungültig; lesen Sie die Startmeldungen</translation>
    </message>
    <message>
        <source>the controller was reset during motion</source>
        <translation>die Steuerung wurde in Bewegung zurückgesetzt</translation>
    </message>
    <message>
        <source>probe: not in the expected state before probing</source>
        <translation>Messtaster: vor dem Antasten nicht im erwarteten Zustand</translation>
    </message>
    <message>
        <source>probe: no contact within the travel</source>
        <translation>Messtaster: kein Kontakt innerhalb des Wegs</translation>
    </message>
    <message>
        <source>homing: the pull-off did not clear the limit switch</source>
        <translation>Referenzfahrt: beim Zurückfahren wurde der Endschalter nicht frei</translation>
    </message>
    <message>
        <source>the emergency stop is pressed; release it, then clear the fault</source>
        <translation>der Not-Halt ist gedrückt; ihn lösen, dann den Fehler quittieren</translation>
    </message>
    <message>
        <source>homing: not permitted by the configuration</source>
        <translation>Referenzfahrt: die Konfiguration lässt sie nicht zu</translation>
    </message>
    <message>
        <source>the stored settings cannot be read or written</source>
        <translation>die gespeicherten Einstellungen lassen sich nicht lesen oder schreiben</translation>
    </message>
    <message>
        <source>the input buffer overflowed</source>
        <translation>der Eingangspuffer lief über</translation>
    </message>
    <message>
        <source>the hard stop was pressed; release it, then clear the fault</source>
        <translation>der Sofort-Halt wurde gedrückt; ihn lösen, dann den Fehler quittieren</translation>
    </message>
    <message>
        <source>the controller has just started; clear the fault, then home</source>
        <translation>die Steuerung ist gerade erst gestartet; den Fehler quittieren, dann Referenzfahrt</translation>
    </message>
    <message>
        <source>a G-code error stopped the program</source>
        <translation>ein G-Code-Fehler hielt das Programm an</translation>
    </message>
    <message>
        <source>a number that {firmware} does not document; see the maker&apos;s manual</source>
        <translation>eine Nummer, die {firmware} nicht dokumentiert; siehe Handbuch des Herstellers</translation>
    </message>
    <message>
        <source>{what}:{number}, {meaning}</source>
        <translation>{what}:{number}, {meaning}</translation>
    </message>
    <message>
        <source>axis {name}: the controller has no setting ${first}; it needs one for each of the {count} axes</source>
        <translation>Achse {name}: die Steuerung hat keine Einstellung ${first}; sie braucht eine für jede der {count} Achsen</translation>
    </message>
    <message>
        <source>axis {name}: after homing the controller counts {count} {unit}, which is not within its range: the robot file has {low} to {high} {unit}, the controller travels {travel} {unit} (${setting}). Correct ${setting} and the homing settings ($22, $23, $27), or the robot file</source>
        <translation>Achse {name}: nach der Referenzfahrt zählt die Steuerung {count} {unit}, das liegt nicht in ihrem Bereich: die Roboterdatei hat {low} bis {high} {unit}, der Verfahrweg der Steuerung ist {travel} {unit} (${setting}). ${setting} und die Einstellungen der Referenzfahrt ($22, $23, $27) oder die Roboterdatei berichtigen</translation>
    </message>
    <message>
        <source>the controller&apos;s settings do not agree with the robot file: {differences}. Send them to the controller, or correct the file</source>
        <translation>die Einstellungen der Steuerung passen nicht zur Roboterdatei: {differences}. Sie an die Steuerung senden oder die Datei berichtigen</translation>
    </message>
    <message>
        <source>axis {name}: ${setting} = {present}, the file has {value} {unit} (${setting}={value})</source>
        <translation>Achse {name}: ${setting} = {present}, die Datei hat {value} {unit} (${setting}={value})</translation>
    </message>
    <message>
        <source>robot {name} has {count} axes; the letters {letters} name {letter_count}</source>
        <translation>Roboter {name} hat {count} Achsen; die Buchstaben {letters} nennen {letter_count}</translation>
    </message>
    <message>
        <source>robot {robot}: axis {axis} is moved by a {kind}, but a G-code controller moves stepping motors; choose a robot file with such axes only, such as xyz</source>
        <translation>Roboter {robot}: Achse {axis} wird von {kind} bewegt; eine G-Code-Steuerung bewegt Schrittmotoren: eine Roboterdatei nur mit solchen Achsen nehmen, etwa xyz</translation>
    </message>
    <message>
        <source>gcode: letters = {letters}: must be different letters of XYZABCUVW</source>
        <translation>gcode: letters = {letters}: müssen verschiedene Buchstaben aus XYZABCUVW sein</translation>
    </message>
    <message>
        <source>{url}: the controller has {count} axes, robot {robot} {expected}; choose the robot file of this stage</source>
        <translation>{url}: die Steuerung hat {count} Achsen, Roboter {robot} {expected}; die Roboterdatei dieses Tischs wählen</translation>
    </message>
    <message>
        <source>{url}: {error}</source>
        <translation>{url}: {error}</translation>
    </message>
    <message>
        <source>{name}: the axes are still braking; clear the fault when they rest</source>
        <translation>{name}: die Achsen bremsen noch; den Fehler quittieren, wenn sie ruhen</translation>
    </message>
    <message>
        <source>{name}: this controller homes all axes together; home all {count}, or build it with single-axis homing</source>
        <translation>{name}: diese Steuerung referenziert alle Achsen zusammen; alle {count} referenzieren oder sie mit Einzelreferenzierung bauen</translation>
    </message>
    <message>
        <source>{name} is still handling a stop; try again</source>
        <translation>{name}: noch mit einem Halt beschäftigt; erneut versuchen</translation>
    </message>
    <message>
        <source>{count} reports in a row agree on a position that the axes cannot have reached by themselves; the position is unknown. Home all axes</source>
        <extracomment>A longer time between two steps means that this program was suspended. Then all motion is cancelled.</extracomment>
        <translation>{count} Meldungen in Folge zeigen übereinstimmend eine Position, die die Achsen nicht von selbst erreicht haben können; die Position ist unbekannt. Referenzieren Sie alle Achsen</translation>
    </message>
    <message>
        <source>the move ended before its target: {short}</source>
        <translation>die Bewegung endete vor ihrem Ziel: {short}</translation>
    </message>
    <message>
        <source>the controller refused {line}: {text}</source>
        <translation>die Steuerung lehnte {line} ab: {text}</translation>
    </message>
    <message>
        <source>the controller was reset externally or lost power; clear the fault, then home</source>
        <translation>die Steuerung wurde von außen zurückgesetzt oder verlor ihre Versorgung; den Fehler quittieren, dann Referenzfahrt</translation>
    </message>
    <message>
        <source>{port}: the controller has not answered for {seconds} s; its motion ends within half a second plus the braking time. Check the machine, then reconnect</source>
        <translation>{port}: die Steuerung antwortet seit {seconds} s nicht; ihre Bewegung endet innerhalb einer halben Sekunde zuzüglich der Bremszeit. Prüfen Sie die Maschine, und verbinden Sie dann neu</translation>
    </message>
    <message>
        <source>no report in the last {seconds} s was usable; check the cable, then clear the fault and home</source>
        <translation>in den letzten {seconds} s war keine Meldung brauchbar; prüfen Sie das Kabel, quittieren Sie dann den Fehler und starten Sie eine Referenzfahrt</translation>
    </message>
    <message>
        <source>no answer to {line} within {limit_s} s</source>
        <translation>keine Antwort auf {line} in {limit_s} s</translation>
    </message>
    <message>
        <source>gcode: {name} = {value}: must be {low} to {high}</source>
        <translation>gcode: {name} = {value}: muss {low} bis {high} sein</translation>
    </message>
    <message>
        <source>simulator: robot {name} has a force axis without a controller; add one to the robot file</source>
        <translation>Simulator: Roboter {name} hat eine Kraftachse ohne Regler; in der Roboterdatei einen hinzufügen</translation>
    </message>
    <message>
        <source>simulator: setting {name} = {value} is not between {least} and {greatest}</source>
        <translation>Simulator: Einstellung {name} = {value} liegt nicht zwischen {least} und {greatest}</translation>
    </message>
    <message>
        <source>{name}: the controller of axis {axis} sets its voltage</source>
        <translation>{name}: der Regler von Achse {axis} stellt ihre Spannung</translation>
    </message>
    <message>
        <source>{name}: the inverse of axis {axis} sets its voltage; remove the inverse first</source>
        <translation>{name}: die Inverse von Achse {axis} stellt ihre Spannung; erst die Inverse abschalten</translation>
    </message>
    <message>
        <source>{name}: the loop of axis {axis} sets its voltage; open the loop first</source>
        <translation>{name}: der Regelkreis von Achse {axis} stellt ihre Spannung; ihn erst öffnen</translation>
    </message>
    <message>
        <source>{name}: the axis has moved since the profile was uploaded; wait until it is at rest, and upload the profile again</source>
        <translation>{name}: die Achse hat sich seit dem Hochladen des Profils bewegt; warten Sie, bis sie ruht, und laden Sie das Profil erneut hoch</translation>
    </message>
    <message>
        <source>simulator: the trajectory has {rate_hz} rows per second, but at most {max_rate_hz} can be played; resample the trajectory</source>
        <translation>Simulator: die Zeilen der Trajektorie folgen mit {rate_hz} Hz; er spielt höchstens {max_rate_hz} Hz; die Trajektorie neu abtasten</translation>
    </message>
    <message>
        <source>axis {axis}: a loop at {rate_hz} Hz</source>
        <extracomment>Regulations of the closed loops. Replaced as a whole, so that any thread may read them.</extracomment>
        <translation>Achse {axis}: ein Regelkreis mit {rate_hz} Hz</translation>
    </message>
    <message>
        <source>{where}: the simulated machine samples at {sample_s} Hz, and a loop&apos;s rate must be a whole multiple of that; tune it for such a rate</source>
        <translation>{where}: die simulierte Maschine tastet mit {sample_s} Hz ab, und die Rate eines Regelkreises muss ein ganzes Vielfaches davon sein; für eine solche Rate abstimmen</translation>
    </message>
    <message>
        <source>{where}: the loop of axis {axis} runs at {rate_hz} Hz, and all loops must run at one rate; open that loop, or tune for its rate</source>
        <translation>{where}: der Regelkreis von Achse {axis} läuft mit {rate_hz} Hz, und alle müssen mit derselben Rate laufen; diesen öffnen oder für seine Rate abstimmen</translation>
    </message>
    <message>
        <source>{where}: the robot&apos;s own controllers run at {sample_s} Hz; tune it for that rate, or set the simulator&apos;s sample_rate_hz to the loop&apos;s</source>
        <translation>{where}: die eigenen Regler des Roboters laufen mit {sample_s} Hz; für diese Rate abstimmen oder sample_rate_hz des Simulators auf die des Regelkreises setzen</translation>
    </message>
    <message>
        <source>{name}: potentiometer reading {reading}: must be 0 to 1</source>
        <translation>{name}: ein Potentiometer bei {reading}: muss 0 bis 1 sein</translation>
    </message>
    <message>
        <source>{name}: {device} {unit}, robot file {robot} {unit}</source>
        <translation>{name}: {device} {unit}, Roboterdatei {robot} {unit}</translation>
    </message>
    <message>
        <source>{owner}: unknown setting {unknown}; available: {known}</source>
        <translation>{owner}: unbekannte Einstellung {unknown}; bekannt: {known}</translation>
    </message>
    <message>
        <source>{where}: {value} must be a {name}, like its default {default}</source>
        <translation>{where}: {value} ist kein {name} wie die Vorgabe {default}</translation>
    </message>
    <message>
        <source>{where}: {value} is not a finite number</source>
        <translation>{where}: {value} ist keine endliche Zahl</translation>
    </message>
    <message>
        <source>the connection has changed; try again</source>
        <translation>die Verbindung hat sich geändert; erneut versuchen</translation>
    </message>
    <message>
        <source>a stop came after this request; try again</source>
        <translation>nach dieser Anforderung kam ein Halt; erneut versuchen</translation>
    </message>
    <message>
        <source>the lease of the request has expired; try again</source>
        <translation>die Frist der Anforderung ist abgelaufen; erneut versuchen</translation>
    </message>
    <message>
        <source>driver {name} cannot be used: {broken}</source>
        <translation>Treiber {name} ist nicht nutzbar: {broken}</translation>
    </message>
    <message>
        <source>there is no driver {name}; installed: {names}</source>
        <translation>den Treiber {name} gibt es nicht; installiert: {names}</translation>
    </message>
    <message>
        <source>Keys and on-screen pad</source>
        <translation>Tasten und Bedienfeld am Bildschirm</translation>
    </message>
    <message>
        <source>{name}: {axis} at {deflection}: must be -1 to 1</source>
        <translation>{name}: {axis} bei {deflection}: muss -1 bis 1 sein</translation>
    </message>
    <message>
        <source>{name} ({key}) is not connected</source>
        <translation>{name} ({key}) ist nicht angeschlossen</translation>
    </message>
    <message>
        <source>{name} was removed</source>
        <translation>{name} wurde entfernt</translation>
    </message>
    <message>
        <source>{name}: no {kind} {wanted}; it has {known}</source>
        <translation>{name}: {kind} {wanted} gibt es nicht; vorhanden: {known}</translation>
    </message>
    <message>
        <source>{name} was closed; open it again</source>
        <translation>{name}: geschlossen; wieder öffnen</translation>
    </message>
    <message>
        <source>Joystick of the controller</source>
        <translation>Joystick der Steuerung</translation>
    </message>
    <message>
        <source>{name} does not belong to the driver in use</source>
        <translation>{name} gehört nicht zum verwendeten Treiber</translation>
    </message>
    <message>
        <source>{name}: another driver is in use now</source>
        <translation>{name}: jetzt wird ein anderer Treiber verwendet</translation>
    </message>
    <message>
        <source>{name} now has {axes} axes and {buttons} buttons instead of {axes_before} and {buttons_before}; open it again</source>
        <translation>{name}: hat jetzt {axes} Achsen und {buttons} Tasten, vorher {axes_before} und {buttons_before}; wieder öffnen</translation>
    </message>
    <message>
        <source>{name}: the joystick cannot be read: {error}</source>
        <translation>{name}: der Joystick lässt sich nicht lesen: {error}</translation>
    </message>
    <message>
        <source>{name} is not connected; connect it to use its joystick</source>
        <translation>{name} ist nicht verbunden; verbinden, um den Joystick zu benutzen</translation>
    </message>
    <message>
        <source>{name}: the joystick is disabled during a fault; clear the fault</source>
        <translation>{name}: während eines Fehlers ist der Joystick gesperrt; quittieren Sie den Fehler</translation>
    </message>
    <message>
        <source>{name} and its joystick do not respond; check the connection</source>
        <translation>{name} und sein Joystick antworten nicht; prüfen Sie die Verbindung</translation>
    </message>
    <message>
        <source>{name}: no joystick responds; check that one is plugged in</source>
        <translation>{name}: kein Joystick meldet sich; prüfen Sie, ob einer angesteckt ist</translation>
    </message>
    <message>
        <source>{name} ({key}) is not plugged in</source>
        <translation>{name} ({key}): nicht angesteckt</translation>
    </message>
    <message>
        <source>{name} was unplugged by its script</source>
        <translation>{name} wurde von seinem Skript abgesteckt</translation>
    </message>
    <message>
        <source>{name}: strength {strength}: must be 0 to 1</source>
        <translation>{name}: eine Stärke von {strength}: muss 0 bis 1 sein</translation>
    </message>
    <message>
        <source>input device {key} is not plugged in; available: {keys}</source>
        <translation>Eingabegerät {key} ist nicht angesteckt; vorhanden: {keys}</translation>
    </message>
    <message>
        <source>{name} ({key}) cannot be opened: {type_name}: {error}</source>
        <translation>{name} ({key}) lässt sich nicht öffnen: {type_name}: {error}</translation>
    </message>
    <message>
        <source>no permission to open it. On Linux, put the rule of docs/inputs.md into /etc/udev/rules.d/70-rotemina-inputs.rules, run `sudo udevadm control --reload`, and plug the device in again; elsewhere, allow this program to read input devices</source>
        <translation>keine Berechtigung zum Öffnen. Unter Linux die Regel aus docs/inputs.md in /etc/udev/rules.d/70-rotemina-inputs.rules eintragen, `sudo udevadm control --reload` ausführen und das Gerät neu anstecken; sonst diesem Programm das Lesen von Eingabegeräten erlauben</translation>
    </message>
    <message>
        <source>USB joysticks cannot be used: the library hidapi does not load ({failure}); install it with `pip install hidapi`, and install the system&apos;s libudev</source>
        <translation>USB-Joysticks sind nicht nutzbar: die Bibliothek hidapi lädt nicht ({failure}); installieren Sie sie mit `pip install hidapi` und dazu libudev des Systems</translation>
    </message>
    <message>
        <source>{error}: {said}</source>
        <translation>{error}: {said}</translation>
    </message>
    <message>
        <source>{who}: its report descriptor cannot be read ({error}); unplug it and plug it in again</source>
        <translation>{who}: der Report-Deskriptor kann nicht gelesen werden ({error}); abstecken und wieder anstecken</translation>
    </message>
    <message>
        <source>no reason given</source>
        <translation>kein Grund genannt</translation>
    </message>
    <message>
        <source>{where}: {permission} ({said})</source>
        <translation>{where}: {permission} ({said})</translation>
    </message>
    <message>
        <source>{where}: another program uses it; close that program ({said})</source>
        <translation>{where}: ein anderes Programm verwendet es; das andere schließen ({said})</translation>
    </message>
    <message>
        <source>{where} cannot be opened ({said}); unplug it and plug it in again; see docs/inputs.md</source>
        <translation>{where}: lässt sich nicht öffnen ({said}); abstecken und wieder anstecken; siehe docs/inputs.md</translation>
    </message>
    <message>
        <source>its report descriptor has no axis and no button of a joystick, gamepad or multi-axis controller</source>
        <translation>der Report-Deskriptor enthält weder Achse noch Taste eines Joysticks, Gamepads oder Mehrachsreglers</translation>
    </message>
    <message>
        <source>it sent a report of the undeclared type {number}, and all controls count as released. Release the controls and start again; if this happens again, replug the device</source>
        <extracomment>Why the latest report could not be decoded; None if it could.</extracomment>
        <translation>es sandte eine Meldung vom Typ {number}, den es nicht angibt, und gilt als losgelassen. Lassen Sie alles los und beginnen Sie neu; falls es wieder geschieht, stecken Sie das Gerät neu an</translation>
    </message>
    <message>
        <source>it sent a report of {length} bytes after reports of {longest}, and all controls count as released. Release the controls and start again; if this happens again, replug the device</source>
        <translation>es sandte eine Meldung von {length} Byte nach Meldungen von {longest} und gilt als losgelassen. Lassen Sie alles los und beginnen Sie neu; falls es wieder geschieht, stecken Sie das Gerät neu an</translation>
    </message>
    <message>
        <source>USB and Bluetooth joysticks</source>
        <translation>USB- und Bluetooth-Joysticks</translation>
    </message>
    <message>
        <source>hidapi finds {count} HID devices but does not report which are joysticks, because it was built with libusb. Install a version that uses hidraw (`pip install hidapi`)</source>
        <translation>hidapi findet {count} HID-Geräte, meldet aber nicht, welche davon Joysticks sind, weil es mit libusb gebaut ist. Installieren Sie eine Version, die hidraw verwendet (`pip install hidapi`)</translation>
    </message>
    <message>
        <source>{name}: {error}; it cannot be used</source>
        <translation>{name}: {error}; nicht nutzbar</translation>
    </message>
    <message>
        <source>its report descriptor is invalid at byte {at}: {what}</source>
        <translation>der Report-Deskriptor ist bei Byte {at} ungültig: {what}</translation>
    </message>
    <message>
        <source>{name} was unplugged, or lost its power or radio link ({error})</source>
        <translation>{name}: abgesteckt, oder Strom oder Funkverbindung verloren ({error})</translation>
    </message>
    <message>
        <source>moment {number}</source>
        <translation>Zeitpunkt {number}</translation>
    </message>
    <message>
        <source>{where}: time {time_s} s: must be later than the previous one ({before} s)</source>
        <translation>{where}: Zeit {time_s} s: muss später als die vorige sein ({before} s)</translation>
    </message>
    <message>
        <source>{where}: {axes} axes and {buttons} buttons: must be {axes_wanted} and {buttons_wanted}</source>
        <translation>{where}: {axes} Achsen und {buttons} Tasten: müssen {axes_wanted} und {buttons_wanted} sein</translation>
    </message>
    <message>
        <source>{where}: {name} at {deflection}: must be -1 to 1</source>
        <translation>{where}: {name} bei {deflection}: muss -1 bis 1 sein</translation>
    </message>
    <message>
        <source>name a CSV file</source>
        <translation>eine CSV-Datei angeben</translation>
    </message>
    <message>
        <source>{path}: cannot be read: {error}</source>
        <translation>{path}: kann nicht gelesen werden: {error}</translation>
    </message>
    <message>
        <source>{path}: {error}</source>
        <translation>{path}: {error}</translation>
    </message>
    <message>
        <source>{path}, line 1: column {time} is missing</source>
        <translation>{path}, Zeile 1: die Spalte {time} fehlt</translation>
    </message>
    <message>
        <source>{path}, line 1: unknown column {name}; permitted are {time}, {plugged}, &apos;axis NAME&apos; and &apos;button NAME&apos;</source>
        <translation>{path}, Zeile 1: unbekannte Spalte {name}; möglich: {time}, {plugged}, &apos;axis NAME&apos; und &apos;button NAME&apos;</translation>
    </message>
    <message>
        <source>{path}, line 1: column {name} appears twice</source>
        <translation>{path}, Zeile 1: Spalte {name} kommt zweimal vor</translation>
    </message>
    <message>
        <source>{where}: {count} values: must be {columns}, as in line 1</source>
        <translation>{where}: {count} Werte: müssen {columns} sein wie in Zeile 1</translation>
    </message>
    <message>
        <source>{where}, column {column}: {value}: must be 0 or 1</source>
        <translation>{where}, Spalte {column}: {value}: muss 0 oder 1 sein</translation>
    </message>
    <message>
        <source>the file</source>
        <translation>die Datei</translation>
    </message>
    <message>
        <source>{name}: {place}: {first}; train it again, or use an unchanged copy</source>
        <translation>{name}: {place}: {first}; neu trainieren oder eine unveränderte Kopie nehmen</translation>
    </message>
    <message>
        <source>axis {axis}: robot {name} has no such piezo axis; use one of {value}</source>
        <translation>Achse {axis}: Roboter {name} hat keine solche Piezoachse; möglich: {value}</translation>
    </message>
    <message>
        <source>another robot</source>
        <translation>einen anderen Roboter</translation>
    </message>
    <message>
        <source>{name}: axis {axis} needs the columns {axis}.{source} and {axis}.{meas} or {axis}.{ref}; record them, or name an axis that has them</source>
        <translation>{name}: Achse {axis} braucht die Spalten {axis}.{source} und {axis}.{meas} oder {axis}.{ref}; sie aufzeichnen oder eine Achse angeben, die sie hat</translation>
    </message>
    <message>
        <source>{name}: axis {axis} is commanded over {travel}, less than {least_travel} of its range of {span}; record larger motions</source>
        <translation>{name}: Achse {axis} wird über {travel} bewegt, weniger als {least_travel} ihres Bereichs von {span}; größere Bewegungen aufzeichnen</translation>
    </message>
    <message>
        <source>{name}: {count} rows are too few; {fewest} are needed</source>
        <translation>{name}: {count} Zeilen sind zu wenig; nötig sind {fewest}</translation>
    </message>
    <message>
        <source>{name}: row {row} comes {lengths} s after the previous one, others {sample_s} s; an inverse needs evenly spaced rows: resample the record (rotemina convert)</source>
        <translation>{name}: Zeile {row} kommt {lengths} s nach der vorigen, andere {sample_s} s; eine Inverse braucht gleichmäßige Zeit: die Aufzeichnung neu abtasten (rotemina convert)</translation>
    </message>
    <message>
        <source>there is no record to train on; name at least one</source>
        <translation>keine Aufzeichnung zum Trainieren; mindestens eine angeben</translation>
    </message>
    <message>
        <source>{name}: its rows come every {sample_s} s, those of {first_name} every {first_sample_s} s; resample them to one rate (rotemina convert)</source>
        <translation>{name}: ihre Zeilen kommen alle {sample_s} s, die von {first_name} alle {first_sample_s} s; auf eine Rate neu abtasten (rotemina convert)</translation>
    </message>
    <message>
        <source>inverse of axis {axis}: sample_s = {sample_s} s: must be finite, above 0</source>
        <translation>Inverse von Achse {axis}: sample_s = {sample_s} s: muss endlich und größer als 0 sein</translation>
    </message>
    <message>
        <source>inverse of axis {axis}: a state of shape {shape} was given; it must have shape {state_shape} and only finite values; use a state of this inverse</source>
        <translation>Inverse von Achse {axis}: der Zustand hat die Form {shape}; er muss die Form {state_shape} und lauter endliche Werte haben; einen Zustand dieser Inversen nehmen</translation>
    </message>
    <message>
        <source>inverse of axis {axis}: desired positions of shape {shape} must be one column of finite numbers</source>
        <translation>Inverse von Achse {axis}: gewünschte Positionen der Form {shape} müssen eine Spalte endlicher Zahlen sein</translation>
    </message>
    <message>
        <source>inverse of axis {axis}: desired position {desired} at sample {at} lies outside {low} to {high}, which the inverse was trained on; stay inside, or train it on a wider record</source>
        <translation>Inverse von Achse {axis}: gewünschte Position {desired} beim Abtastwert {at} liegt außerhalb von {low} bis {high}, dem Trainingsbereich der Inversen; innerhalb bleiben oder mit einer größeren Bewegung trainieren</translation>
    </message>
    <message>
        <source>axis {axis}: robot {name} has no such piezo axis</source>
        <translation>Achse {axis}: Roboter {name} hat keine solche Piezoachse</translation>
    </message>
    <message>
        <source>ANFIS: the training did not converge: after {count} epochs it leaves {error} rms of commands that vary by {spread}; nothing was replaced. Record slower motions over the whole range, or use another kind</source>
        <translation>ANFIS: das Training konvergierte nicht: nach {count} Epochen bleiben {error} rms von Sollwerten, die um {spread} schwanken; nichts wurde ersetzt. Langsamere Bewegungen über den ganzen Bereich aufzeichnen oder eine andere Art nehmen</translation>
    </message>
    <message>
        <source>lag and creep</source>
        <translation>Nachlauf und Kriechen</translation>
    </message>
    <message>
        <source>{name}: axis {axis}: fewer than {fewest} rows are left to train on, after the first swing over the whole range; record longer</source>
        <translation>{name}: Achse {axis}: nach dem ersten Hub über den ganzen Bereich bleiben weniger als {fewest} Zeilen zum Trainieren; länger aufzeichnen</translation>
    </message>
    <message>
        <source>plays</source>
        <translation>Play-Operatoren</translation>
    </message>
    <message>
        <source>ANFIS, epoch {epoch}: {error} unseen</source>
        <translation>ANFIS, Epoche {epoch}: {error} auf Prüfzeilen</translation>
    </message>
    <message>
        <source>done</source>
        <translation>fertig</translation>
    </message>
    <message>
        <source>inverse of axis {axis}: the trajectory commands {names}; it must command this piezo axis, or use the inverse of another one</source>
        <translation>Inverse von Achse {axis}: die Trajektorie bewegt {names}; sie muss diese Piezoachse bewegen, oder die Inverse einer anderen nehmen</translation>
    </message>
    <message>
        <source>axis {axis}: the trajectory is already compensated ({metadata}); use the original one</source>
        <translation>Achse {axis}: die Trajektorie ist schon kompensiert ({metadata}); die ursprüngliche nehmen</translation>
    </message>
    <message>
        <source>trajectory: it has only one row; an inverse needs a path of several</source>
        <translation>Trajektorie: sie hat eine Zeile; eine Inverse braucht einen Weg aus mehreren</translation>
    </message>
    <message>
        <source>trajectory: row {row} comes {lengths} s after the previous one, others {sample_s} s; an inverse needs evenly spaced rows: resample the trajectory</source>
        <translation>Trajektorie: Zeile {row} kommt {lengths} s nach der vorigen, andere {sample_s} s; eine Inverse braucht gleichmäßige Zeit: die Trajektorie neu abtasten</translation>
    </message>
    <message>
        <source>modified Prandtl–Ishlinskii</source>
        <translation>modifiziertes Prandtl–Ishlinskii</translation>
    </message>
    <message>
        <source>linear</source>
        <translation>linear</translation>
    </message>
    <message>
        <source>axis {axis}: no row lies within {low} to {high}, the training range of the inverse; use such a record for the check, or train with a wider one</source>
        <translation>Achse {axis}: keine Zeile liegt zwischen {low} und {high}, dem Trainingsbereich der Inversen; mit einer solchen Aufzeichnung prüfen oder mit einer größeren Bewegung trainieren</translation>
    </message>
    <message>
        <source>{kind} {share}</source>
        <translation>{kind} {share}</translation>
    </message>
    <message>
        <source>{kind} leaves {share} of the range on rows that no inverse was trained on; {others}.</source>
        <translation>{kind} lässt {share} des Bereichs übrig, auf Zeilen, mit denen keine Inverse trainiert wurde; {others}.</translation>
    </message>
    <message>
        <source>All swings have one size, so richer kinds would only guess at other sizes: train with swings that grow or fade.</source>
        <translation>Alle Hübe sind gleich groß; reichere Arten könnten bei anderen Größen nur raten: mit wachsenden oder abklingenden Hüben trainieren.</translation>
    </message>
    <message>
        <source>It is the simplest kind whose residual is within {share} of the smallest.</source>
        <translation>Sie ist die einfachste Art, deren Restabweichung höchstens {share} über der kleinsten liegt.</translation>
    </message>
    <message>
        <source>constant speed over half the stroke</source>
        <translation>konstante Geschwindigkeit über den halben Hub</translation>
    </message>
    <message>
        <source>at least one row at constant speed</source>
        <translation>mindestens eine Zeile mit konstanter Geschwindigkeit</translation>
    </message>
    <message>
        <source>whole rows between the corners</source>
        <translation>ganze Zeilen zwischen den Ecken</translation>
    </message>
    <message>
        <source>axis {axis}: speed {speed} must be above 0</source>
        <translation>Achse {axis}: Geschwindigkeit {speed} muss größer als 0 sein</translation>
    </message>
    <message>
        <source>{text} is not a finite number</source>
        <translation>{text} ist keine endliche Zahl</translation>
    </message>
    <message>
        <source>{text} has no unit; write it like 200urad, 5um or 30%</source>
        <translation>{text} hat keine Einheit; schreiben wie 200urad, 5um oder 30%</translation>
    </message>
    <message>
        <source>{text}: {error}</source>
        <translation>{text}: {error}</translation>
    </message>
    <message>
        <source>axis {axis}: {text} is in {unit}, not in {wanted}</source>
        <translation>Achse {axis}: {text} ist in {unit}, nicht in {wanted}</translation>
    </message>
    <message>
        <source>{name} = {value}: must be a finite number above 0</source>
        <translation>{name} = {value}: muss eine endliche Zahl über 0 sein</translation>
    </message>
    <message>
        <source>{name} = {value}: must lie between {least} and {most}</source>
        <translation>{name} = {value}: muss zwischen {least} und {most} liegen</translation>
    </message>
    <message>
        <source>axis {axis}: jerk {jerk} must be a value above 0</source>
        <translation>Achse {axis}: Ruck {jerk} muss größer als 0 sein</translation>
    </message>
    <message>
        <source>axis {axis}: clock {asked} Hz must not exceed the rate {rate_hz} Hz</source>
        <translation>Achse {axis}: Takt {asked} Hz darf die Rate {rate_hz} Hz nicht übersteigen</translation>
    </message>
    <message>
        <source>whole rows in a chip</source>
        <translation>ganze Zeilen je Chip</translation>
    </message>
    <message>
        <source>excitation: no axis is named; name at least one</source>
        <translation>Anregung: keine Achse genannt; mindestens eine angeben</translation>
    </message>
    <message>
        <source>seed {seed}: must be 0 or more</source>
        <translation>seed {seed}: muss 0 oder größer sein</translation>
    </message>
    <message>
        <source>axis {name}: robot {robot_name} has no such axis; use one of {names}</source>
        <translation>Achse {name}: Roboter {robot_name} hat keine solche Achse; möglich: {names}</translation>
    </message>
    <message>
        <source>rate {rate_hz} Hz: must lie above 0 and up to {fastest_hz} Hz</source>
        <translation>Rate {rate_hz} Hz: muss über 0 liegen, höchstens {fastest_hz} Hz</translation>
    </message>
    <message>
        <source>axis {name}: rate {rate_hz} Hz is below {slowest_hz} Hz: the device would rest between rows and jump, which exceeds its speed and acceleration</source>
        <translation>Achse {name}: Rate {rate_hz} Hz liegt unter {slowest_hz} Hz: das Gerät stünde zwischen den Zeilen und spränge, über seine Geschwindigkeit und Beschleunigung hinaus</translation>
    </message>
    <message>
        <source>whole periods</source>
        <translation>ganze Perioden</translation>
    </message>
    <message>
        <source>axis {axis}: chirp from {low} Hz to {high} Hz has less than one period in {duration_s} s; lengthen it</source>
        <translation>Achse {axis}: ein Chirp von {low} Hz bis {high} Hz hat in {duration_s} s weniger als eine Periode; verlängern</translation>
    </message>
    <message>
        <source>end of the band</source>
        <translation>Ende des Bands</translation>
    </message>
    <message>
        <source>detection = 1: would leave out every line; use 0, or 2 or more</source>
        <translation>detection = 1: ließe jede Linie aus; 0 oder ab 2 verwenden</translation>
    </message>
    <message>
        <source>slope = {slope}: must lie between -4 and 4</source>
        <translation>slope = {slope}: muss zwischen -4 und 4 liegen</translation>
    </message>
    <message>
        <source>axis {axis}: no odd multiple of 1/period_s = {period_s} Hz lies in the band; widen it or lengthen the period</source>
        <translation>Achse {axis}: kein ungerades Vielfaches von 1/period_s = {period_s} Hz liegt im Band; es verbreitern oder die Periode verlängern</translation>
    </message>
    <message>
        <source>axis {axis}: band from {low} Hz to {high} Hz ends below its beginning</source>
        <translation>Achse {axis}: das Band von {low} Hz bis {high} Hz endet unter seinem Anfang</translation>
    </message>
    <message>
        <source>axis {axis}: offset {said} leaves no room to move between {low} and {high}</source>
        <translation>Achse {axis}: Versatz {said} lässt keinen Platz zur Bewegung zwischen {low} und {high}</translation>
    </message>
    <message>
        <source>axis {axis}: amplitude {value} must be above 0</source>
        <translation>Achse {axis}: Amplitude {value} muss größer als 0 sein</translation>
    </message>
    <message>
        <source>axis {axis}: {duration_s} s at {rate_hz} Hz is more than {most_rows} rows; shorten it or lower the rate</source>
        <translation>Achse {axis}: {duration_s} s bei {rate_hz} Hz sind mehr als {most_rows} Zeilen; kürzen oder die Rate senken</translation>
    </message>
    <message>
        <source>axis {axis}: {name} {value} Hz must be below half the rate, {rate_hz} Hz</source>
        <translation>Achse {axis}: {name} {value} Hz muss unter der halben Rate liegen, {rate_hz} Hz</translation>
    </message>
    <message>
        <source>excitation: {rows} rows of {count} axes are more than {most_rows} values; shorten it or lower the rate</source>
        <translation>Anregung: {rows} Zeilen von {count} Achsen sind mehr als {most_rows} Werte; kürzen oder die Rate senken</translation>
    </message>
    <message>
        <source>axis {axis}: loop at {interval_s} Hz</source>
        <translation>Achse {axis}: Regelkreis mit {interval_s} Hz</translation>
    </message>
    <message>
        <source>{where}: unstable, its largest pole {radius} is not inside the unit circle; lower the gains, or put a notch at the resonance; nothing was applied</source>
        <translation>{where}: instabil, der größte Pol {radius} liegt nicht innerhalb des Einheitskreises; die Verstärkungen verringern oder ein Kerbfilter an die Resonanz setzen; nichts wurde angewendet</translation>
    </message>
    <message>
        <source>{where}: peak sensitivity Ms = {peak} at {peak_hz} Hz, must be at most {most}; lower the gains; nothing was applied</source>
        <translation>{where}: Empfindlichkeitsspitze Ms = {peak} bei {peak_hz} Hz, höchstens {most}; die Verstärkungen verringern; nichts wurde angewendet</translation>
    </message>
    <message>
        <source>controller: reference {reference}, measured {measured}: both must be finite; hold the last output until the sensor answers again</source>
        <translation>Regler: Sollwert {reference}, Messwert {measured}: beide müssen endlich sein; die letzte Ausgabe halten, bis der Sensor wieder antwortet</translation>
    </message>
    <message>
        <source>loop interval {interval_s} s: must be positive and finite</source>
        <translation>Intervall {interval_s} s des Regelkreises: muss positiv und endlich sein</translation>
    </message>
    <message>
        <source>{name} at {frequency_hz} Hz: must lie above 0 and below half the loop&apos;s rate, {rate_hz} Hz</source>
        <translation>{name} bei {frequency_hz} Hz: muss über 0 und unter der halben Rate des Regelkreises liegen, {rate_hz} Hz</translation>
    </message>
    <message>
        <source>notch frequency</source>
        <translation>Frequenz des Kerbfilters</translation>
    </message>
    <message>
        <source>notch damping</source>
        <translation>Dämpfung des Kerbfilters</translation>
    </message>
    <message>
        <source>notch depth</source>
        <translation>Tiefe des Kerbfilters</translation>
    </message>
    <message>
        <source>output limits: low {low}, high {high}: low must be less than high</source>
        <translation>Grenzen der Ausgabe: unten {low}, oben {high}: die untere muss kleiner als die obere sein</translation>
    </message>
    <message>
        <source>output limits: rate {rate} per s: must be more than 0</source>
        <translation>Grenzen der Ausgabe: Rate {rate} je s: muss größer als 0 sein</translation>
    </message>
    <message>
        <source>{name} {value}: must be finite, more than {low}</source>
        <translation>{name} {value}: muss endlich und größer als {low} sein</translation>
    </message>
    <message>
        <source>{name} {value}: must be finite, at least {low}</source>
        <translation>{name} {value}: muss endlich und mindestens {low} sein</translation>
    </message>
    <message>
        <source>at most {high}</source>
        <translation>höchstens {high}</translation>
    </message>
    <message>
        <source>axis {axis}: robot {name} has no such axis; use one of {names}</source>
        <translation>Achse {axis}: Roboter {name} hat keine solche Achse; möglich: {names}</translation>
    </message>
    <message>
        <source>{name} = {value} is not between {least} and {most}</source>
        <translation>{name} = {value} liegt nicht zwischen {least} und {most}</translation>
    </message>
    <message>
        <source>loop rate {rate_hz} Hz: must be more than 0, at most {fastest_hz} Hz</source>
        <translation>Rate des Regelkreises {rate_hz} Hz: muss größer als 0 und höchstens {fastest_hz} Hz sein</translation>
    </message>
    <message>
        <source>loop delay of {delay} intervals: must be 0 to {longest_delay}</source>
        <translation>Totzeit des Regelkreises {delay} Intervalle: muss 0 bis {longest_delay} sein</translation>
    </message>
    <message>
        <source>{error} (with gain or resonance off by {spread} %)</source>
        <translation>{error} (mit Verstärkung oder Resonanz um {spread} % daneben)</translation>
    </message>
    <message>
        <source>axis {axis}: effect delay of {delay_s} s is {intervals} intervals of a loop at {rate_hz} Hz, and must be a whole number of them; choose another rate or delay</source>
        <translation>Achse {axis}: die Totzeit {delay_s} s ihres Effekts ist das {intervals}-Fache des Intervalls eines Regelkreises mit {rate_hz} Hz und muss ein ganzes Vielfaches sein; eine andere Rate oder Totzeit wählen</translation>
    </message>
    <message>
        <source>it has added {much} (at most {share} of the range is permitted)</source>
        <translation>er hat {much} hinzugefügt (höchstens {share} des Bereichs)</translation>
    </message>
    <message>
        <source>axis {name}: its loop was opened because the axis does not respond: {what}; check the sensor and the actuator, clear the fault, then close the loop again</source>
        <translation>Achse {name}: ihr Regelkreis wurde geöffnet, weil die Achse nicht reagiert: {what}; Sensor und Antrieb prüfen, den Fehler quittieren, dann den Regelkreis wieder schließen</translation>
    </message>
    <message>
        <source>axis {axes}: the response of the loop grows without bound; lower the gains</source>
        <translation>Achse {axes}: die Antwort des Regelkreises wächst unbegrenzt; die Verstärkungen verringern</translation>
    </message>
    <message>
        <source>{name} cannot be read (file not found){then}</source>
        <translation>{name} kann nicht gelesen werden (Datei nicht gefunden){then}</translation>
    </message>
    <message>
        <source>{name} cannot be read ({reason}){then}</source>
        <translation>{name} kann nicht gelesen werden ({reason}){then}</translation>
    </message>
    <message>
        <source>{name}: not UTF-8 text (byte {start})</source>
        <translation>{name}: kein UTF-8-Text (Byte {start})</translation>
    </message>
    <message>
        <source>{source}: not valid TOML: {cause}</source>
        <translation>{source}: kein gültiges TOML: {cause}</translation>
    </message>
    <message>
        <source>{source}:{lineno}: not valid JSON: {msg}</source>
        <translation>{source}:{lineno}: kein gültiges JSON: {msg}</translation>
    </message>
    <message>
        <source>{source}: not valid JSON: {cause}</source>
        <translation>{source}: kein gültiges JSON: {cause}</translation>
    </message>
    <message>
        <source>it is a folder</source>
        <translation>das ist ein Ordner</translation>
    </message>
    <message>
        <source>it is a pipe or a device, not a file</source>
        <translation>das ist eine Pipe oder ein Gerät und keine Datei</translation>
    </message>
    <message>
        <source>{name}: larger than {most_bytes} bytes, so it is another kind of file{then}</source>
        <translation>{name}: größer als {most_bytes} Byte, also eine andere Art von Datei{then}</translation>
    </message>
    <message>
        <source>{source}: tables or lists are nested more than {deepest} levels deep</source>
        <translation>{source}: Tabellen oder Listen sind mehr als {deepest} Ebenen tief verschachtelt</translation>
    </message>
    <message>
        <source>{source}: an integer has {count} digits; at most 18 are permitted</source>
        <translation>{source}: eine ganze Zahl mit {count} Ziffern; höchstens 18</translation>
    </message>
    <message>
        <source>tip: the target is not a finite position; give x, y and z in m</source>
        <translation>Spitze: das Ziel ist keine endliche Position; x, y und z in m angeben</translation>
    </message>
    <message>
        <source>{name} has shape {shape}; it must have ({n}, {n}) finite numbers, with a row and a column for each of {names}</source>
        <translation>{name} hat die Form {shape}; nötig sind ({n}, {n}) endliche Zahlen mit je einer Zeile und Spalte für {names}</translation>
    </message>
    <message>
        <source>accelerations under a perturbation by its rate have no finite response; use velocities</source>
        <translation>Beschleunigungen bei einer Störung über deren Rate haben keine endliche Antwort; nach Geschwindigkeiten fragen</translation>
    </message>
    <message>
        <source>the samples after t = {time_s} s are {apart_s} s apart, but the rounding there is {tick} s; count time from the start of the record</source>
        <translation>die Abtastwerte nach t = {time_s} s liegen {apart_s} s auseinander, gerundet wird dort auf {tick} s; die Zeit ab dem Beginn der Aufzeichnung zählen</translation>
    </message>
    <message>
        <source>period_samples = {period}: the record has only {rows} rows</source>
        <translation>period_samples = {period}: die Aufzeichnung hat nur {rows} Zeilen</translation>
    </message>
    <message>
        <source>the model does not reach a steady state within {most_periods} periods; use &apos;# history: unknown&apos;</source>
        <translation>das Modell schwingt in {most_periods} Perioden nicht ein; &apos;# history: unknown&apos; verwenden</translation>
    </message>
    <message>
        <source>axis {axes} has no steady state because nothing holds it; use &apos;# history: unknown&apos;</source>
        <translation>Achse {axes}: sie hat keinen eingeschwungenen Zustand, nichts hält sie; &apos;# history: unknown&apos; verwenden</translation>
    </message>
    <message>
        <source>perturbation: acceleration has shape {shape}; give it a row for each sample and a column for each axis</source>
        <translation>Störung: acceleration hat die Form {shape}; eine Zeile je Abtastwert und eine Spalte je Achse angeben</translation>
    </message>
    <message>
        <source>perturbation: {name} has shape {shape}; acceleration has {axes} axes, so it must be {wanted}</source>
        <translation>Störung: {name} hat die Form {shape}; acceleration hat {axes} Achsen, also muss sie {wanted} sein</translation>
    </message>
    <message>
        <source>perturbation: {name}{place} is not finite</source>
        <translation>Störung: {name}{place} ist nicht endlich</translation>
    </message>
    <message>
        <source>perturbation: it has {shape} axes; the plant has {count}: {names}</source>
        <translation>Störung: sie hat {shape} Achsen; die Strecke hat {count}: {names}</translation>
    </message>
    <message>
        <source>perturbation: it has {count} rows; the commands have {rows}</source>
        <translation>Störung: sie hat {count} Zeilen; die Sollwerte haben {rows}</translation>
    </message>
    <message>
        <source>{array} is not a flat, contiguous array</source>
        <translation>{array}: kein flaches, zusammenhängendes Feld</translation>
    </message>
    <message>
        <source>perturbation: none is given, but Q of the previous row still acts; pass one for every piece of a run, with zeros where nothing shakes</source>
        <translation>Störung: keine angegeben, und Q der vorigen Zeile wirkt noch; für jedes Stück eines Laufs eine angeben, mit Nullen, wo nichts rüttelt</translation>
    </message>
    <message>
        <source>axis {axis}: the response grows without bound at t = {time_s} s; check the commands,{named} and the controller&apos;s gains</source>
        <translation>Achse {axis}: die Antwort wächst bei t = {time_s} s unbegrenzt; die Sollwerte prüfen,{named} und die Verstärkungen des Reglers</translation>
    </message>
    <message>
        <source>axis {axis} of the record: robot {name} has only {known}</source>
        <translation>Achse {axis} der Aufzeichnung: Roboter {name} hat {known}</translation>
    </message>
    <message>
        <source>axis {quoted} of the record: it has no {axis}.cmd column to drive the model</source>
        <translation>Achse {quoted} der Aufzeichnung: es fehlt die Spalte {axis}.cmd, die das Modell treibt</translation>
    </message>
    <message>
        <source>axis {quoted} {reason}: an open-loop run needs a {axis}.u column in the record; add it, or use &apos;# mode: closed_loop&apos; and a controller in the robot file</source>
        <translation>Achse {quoted} {reason}: ein ungeregelter Lauf braucht in der Aufzeichnung eine Spalte {axis}.u; ergänzen Sie sie oder verwenden Sie &apos;# mode: closed_loop&apos; und einen Regler in der Roboterdatei</translation>
    </message>
    <message>
        <source>axis.{axis}.effect {id}: formulation {name}: {what}: {type_name}: {reason}</source>
        <translation>axis.{axis}.effect {id}: Formulierung {name}: {what}: {type_name}: {reason}</translation>
    </message>
    <message>
        <source>{value} is not imported: {fault}</source>
        <translation>{value} wird nicht importiert: {fault}</translation>
    </message>
    <message>
        <source>{value} cannot be imported: {name}: {error}</source>
        <translation>{value} kann nicht importiert werden: {name}: {error}</translation>
    </message>
    <message>
        <source>{value} is made for version {version} of the interface, but this program has version {wanted}: install a matching version of the plugin</source>
        <translation>{value} ist für Version {version} der Schnittstelle gemacht, dieses Programm hat Version {wanted}: eine dafür gemachte Version des Plugins installieren</translation>
    </message>
    <message>
        <source>record: it holds no rows</source>
        <translation>Aufzeichnung: sie enthält keine Zeilen</translation>
    </message>
    <message>
        <source>record: the piece from t = {time_s} s has other columns than the first</source>
        <translation>Aufzeichnung: das Stück ab t = {time_s} s hat andere Spalten als das erste</translation>
    </message>
    <message>
        <source>record: the piece from t = {time_s} s does not follow the previous one, which ends at t = {last_s} s</source>
        <translation>Aufzeichnung: das Stück ab t = {time_s} s folgt nicht auf das vorige, das bei t = {last_s} s endet</translation>
    </message>
    <message>
        <source>units: the record has no axis {axis}; its axes are {names}</source>
        <translation>Einheiten: die Aufzeichnung hat keine Achse {axis}; ihre Achsen sind {names}</translation>
    </message>
    <message>
        <source>units:{axis}: {error}</source>
        <translation>Einheiten:{axis}: {error}</translation>
    </message>
    <message>
        <source>units:{axis}: {unit} cannot be converted to {units}; use another unit</source>
        <translation>Einheiten:{axis}: {unit} lässt sich nicht in {units} umrechnen; eine andere Einheit verwenden</translation>
    </message>
    <message>
        <source>record:{column}: too large for [{unit}]; choose a larger unit</source>
        <translation>Aufzeichnung:{column}: zu groß für [{unit}]; eine größere Einheit wählen</translation>
    </message>
    <message>
        <source>{fspath}: no header and no rows; the record is empty</source>
        <translation>{fspath}: keine Kopfzeile und keine Zeilen; die Aufzeichnung ist leer</translation>
    </message>
    <message>
        <source>resampling: unknown method {method}; use one of {names}</source>
        <translation>Neuabtastung: unbekanntes Verfahren {method}; möglich: {names}</translation>
    </message>
    <message>
        <source>resampling: rate {rate_hz} Hz; use a positive number</source>
        <translation>Neuabtastung: Rate {rate_hz} Hz; eine positive Zahl verwenden</translation>
    </message>
    <message>
        <source>resampling: {steps} rows at {rate_hz} Hz exceed {values} values; lower the rate</source>
        <translation>Neuabtastung: {steps} Zeilen bei {rate_hz} Hz übersteigen {values} Werte; die Rate senken</translation>
    </message>
    <message>
        <source>record: {names} has shape {shape}, expected {value} from time</source>
        <translation>Aufzeichnung: {names} hat die Form {shape}, nach der Zeit erwartet: {value}</translation>
    </message>
    <message>
        <source>record: {key} = {text}: must be a number above 0, in m or rad (rms)</source>
        <translation>Aufzeichnung: {key} = {text}: muss eine Zahl über 0 sein, in m oder rad (rms)</translation>
    </message>
    <message>
        <source>record: period_samples = {text}: must be a whole number above 0</source>
        <translation>Aufzeichnung: period_samples = {text}: muss eine ganze Zahl über 0 sein</translation>
    </message>
    <message>
        <source>record: values have shape {shape}, expected {value} from time and columns</source>
        <translation>Aufzeichnung: die Werte haben die Form {shape}, nach Zeit und Spalten erwartet: {value}</translation>
    </message>
    <message>
        <source>record: it holds no rows or no columns</source>
        <translation>Aufzeichnung: sie enthält keine Zeilen oder keine Spalten</translation>
    </message>
    <message>
        <source>record: a column is named twice</source>
        <translation>Aufzeichnung: eine Spalte kommt zweimal vor</translation>
    </message>
    <message>
        <source>record: no unit given for axis {axis}</source>
        <translation>Aufzeichnung: keine Einheit für Achse {axis}</translation>
    </message>
    <message>
        <source>record: a time or value is not finite</source>
        <translation>Aufzeichnung: eine Zeit oder ein Wert ist nicht endlich</translation>
    </message>
    <message>
        <source>record: time does not increase at row {row} (t = {time_s} s)</source>
        <translation>Aufzeichnung: die Zeit nimmt bei Zeile {row} nicht zu (t = {time_s} s)</translation>
    </message>
    <message>
        <source>name a record file</source>
        <translation>eine Datei mit einer Aufzeichnung angeben</translation>
    </message>
    <message>
        <source>{name}:{line}: the compressed file expands to more than {expanded_bytes} bytes; unpack or split it</source>
        <translation>{name}:{line}: die komprimierte Datei ergibt mehr als {expanded_bytes} Byte; entpacken oder teilen</translation>
    </message>
    <message>
        <source>{name}: the file is empty</source>
        <translation>{name}: die Datei ist leer</translation>
    </message>
    <message>
        <source>{name}:{line}: the compressed file ends early, after this line; it was cut off: copy or record it again</source>
        <translation>{name}:{line}: die komprimierte Datei endet nach dieser Zeile vorzeitig; sie wurde abgeschnitten: neu kopieren oder aufzeichnen</translation>
    </message>
    <message>
        <source>{name}:{line}: the compressed data are damaged after this line ({error}); copy the file again</source>
        <translation>{name}:{line}: die komprimierten Daten sind nach dieser Zeile beschädigt ({error}); die Datei neu kopieren</translation>
    </message>
    <message>
        <source>{name}:{line}: the UTF-16 text is damaged or cut off after this line; copy the file again, or save it as UTF-8</source>
        <translation>{name}:{line}: Der UTF-16-Text ist nach dieser Zeile beschädigt oder abgeschnitten; die Datei erneut kopieren oder als UTF-8 speichern</translation>
    </message>
    <message>
        <source>{name}:{line}: reading failed after this line ({error})</source>
        <translation>{name}:{line}: nach dieser Zeile schlug das Lesen fehl ({error})</translation>
    </message>
    <message>
        <source>{name}:{line_of}: the file is binary or UTF-16, not UTF-8 text; save it as UTF-8</source>
        <translation>{name}:{line_of}: die Datei ist binär oder UTF-16, kein UTF-8-Text; als UTF-8 speichern</translation>
    </message>
    <message>
        <source>{name}:{line_of}: the line is longer than {line_bytes} bytes; is this a record, with LF or CRLF at the end of each line?</source>
        <translation>{name}:{line_of}: die Zeile ist länger als {line_bytes} Byte; ist das eine Aufzeichnung mit LF oder CRLF am Ende jeder Zeile?</translation>
    </message>
    <message>
        <source>{name}: the file contains only zero bytes, probably because of a power cut; use another copy</source>
        <translation>{name}: Die Datei enthält nur Nullbytes, vermutlich durch einen Stromausfall; eine andere Kopie verwenden</translation>
    </message>
    <message>
        <source>{name}:{line}: the file ends in zero bytes, probably because of a power cut; delete everything after line {last}, the last complete one</source>
        <translation>{name}:{line}: Die Datei endet mit Nullbytes, vermutlich durch einen Stromausfall; alles nach Zeile {last}, der letzten vollständigen, löschen</translation>
    </message>
    <message>
        <source>time {time} s does not increase after {last} s; each row must be later than the one before</source>
        <translation>Zeit {time} s nimmt nach {last} s nicht zu; jede Zeile muss später sein als die vorige</translation>
    </message>
    <message>
        <source>{name}:{line}: a second header; the file contains two logs: move the lines from here on to a separate file</source>
        <translation>{name}:{line}: eine zweite Kopfzeile; die Datei enthält zwei Aufzeichnungen: die Zeilen ab hier in eine eigene Datei verschieben</translation>
    </message>
    <message>
        <source>{name}:{line}: the file ends inside this line, at {end}: it was cut off; copy it again, or delete the line</source>
        <translation>{name}:{line}: Die Datei endet mitten in dieser Zeile, bei {end}: Sie wurde abgeschnitten; erneut kopieren oder die Zeile löschen</translation>
    </message>
    <message>
        <source>value {value} exceeds what float64 holds</source>
        <translation>Wert {value} übersteigt, was float64 fasst</translation>
    </message>
    <message>
        <source>value {value} has {sign} where the numbers before have {before}; use one decimal sign and no thousands separators</source>
        <translation>Wert {value} enthält {sign}, die Zahlen davor {before}; ein Dezimalzeichen und keine Tausendertrennzeichen verwenden</translation>
    </message>
    <message>
        <source>tabs</source>
        <translation>Tabulatoren</translation>
    </message>
    <message>
        <source>blanks</source>
        <translation>Leerzeichen</translation>
    </message>
    <message>
        <source>separate {count} columns by {separator}</source>
        <translation>{count} Spalten trennen durch {separator}</translation>
    </message>
    <message>
        <source>if the commas are decimal signs, separate columns by &apos;;&apos;</source>
        <translation>sind die Kommas Dezimalzeichen, die Spalten durch &apos;;&apos; trennen</translation>
    </message>
    <message>
        <source>the row has {count} fields where the header names {wanted}; {advice}</source>
        <translation>die Zeile hat {count} Felder, die Kopfzeile nennt {wanted}; {advice}</translation>
    </message>
    <message>
        <source>{name}:{line}:{column}: {what}</source>
        <translation>{name}:{line}:{column}: {what}</translation>
    </message>
    <message>
        <source>{name}:{line}:byte {start}: {data} is not UTF-8; save the file as UTF-8</source>
        <translation>{name}:{line}:Byte {start}: {data} ist kein UTF-8; die Datei als UTF-8 speichern</translation>
    </message>
    <message>
        <source>the value is missing; write a number, even for a dropout of the sensor</source>
        <translation>der Wert fehlt; eine Zahl schreiben, auch bei einem Sensoraussetzer</translation>
    </message>
    <message>
        <source>value {value} has an unpaired quote; remove it</source>
        <translation>Wert {value} hat ein einzelnes Anführungszeichen; es entfernen</translation>
    </message>
    <message>
        <source>value {value} has a thousands separator; remove it</source>
        <translation>Wert {value} hat ein Tausendertrennzeichen; es entfernen</translation>
    </message>
    <message>
        <source>value {value} is not finite; write a finite number</source>
        <translation>Wert {value} ist nicht endlich; eine endliche Zahl schreiben</translation>
    </message>
    <message>
        <source>value {value} is a spreadsheet&apos;s mark of a missing value or an error; write a number, or delete the row</source>
        <translation>Wert {value} ist das Zeichen einer Tabellenkalkulation für einen fehlenden Wert oder Fehler; eine Zahl eintragen oder die Zeile löschen</translation>
    </message>
    <message>
        <source>value {value} is not a plain decimal number; write it like -12.5 or 3e-6</source>
        <translation>Wert {value} ist keine einfache Dezimalzahl; schreiben wie -12.5 oder 3e-6</translation>
    </message>
    <message>
        <source>the version must be {version}</source>
        <translation>die Version muss {version} sein</translation>
    </message>
    <message>
        <source>use open_loop or closed_loop</source>
        <translation>open_loop oder closed_loop verwenden</translation>
    </message>
    <message>
        <source>use unknown or periodic, or leave the line out for a machine at rest</source>
        <translation>unknown oder periodic verwenden, oder die Zeile weglassen bei einer ruhenden Maschine</translation>
    </message>
    <message>
        <source>use a positive whole number of rows</source>
        <translation>eine positive ganze Zahl von Zeilen verwenden</translation>
    </message>
    <message>
        <source>{where}:{key}: {value} contradicts {values}; keep one</source>
        <translation>{where}:{key}: {value} widerspricht {values}; eines behalten</translation>
    </message>
    <message>
        <source>{where}:{key}: value {value}; {advice}</source>
        <translation>{where}:{key}: Wert {value}; {advice}</translation>
    </message>
    <message>
        <source>metadata:{key}: {value} does not fit in a &apos;# key: value&apos; line; remove line ends, control characters, surrounding blanks, and &apos;:&apos; in the key</source>
        <translation>metadata:{key}: {value} passt in keine Zeile &apos;# key: value&apos;; Zeilenenden, Steuerzeichen, Leerzeichen am Rand und &apos;:&apos; im Schlüssel entfernen</translation>
    </message>
    <message>
        <source>metadata:{key}: longer than {longest} bytes; shorten it</source>
        <translation>metadata:{key}: länger als {longest} Byte; kürzen</translation>
    </message>
    <message>
        <source>{where}: heading {heading} is not &apos;axis.channel [unit]&apos;; write it like {example}</source>
        <translation>{where}: Überschrift {heading} ist kein &apos;axis.channel [unit]&apos;; schreiben wie {example}</translation>
    </message>
    <message>
        <source>{where}: {name}: {error}</source>
        <translation>{where}: {name}: {error}</translation>
    </message>
    <message>
        <source>{where}: heading {heading}; the first column, and only it, must be time: t [s]</source>
        <translation>{where}: Überschrift {heading}; die erste Spalte, und nur sie, muss die Zeit sein: t [s]</translation>
    </message>
    <message>
        <source>{where}: heading {heading} has an unpaired quote; write each heading on one line, like {example}</source>
        <translation>{where}: Überschrift {heading} hat ein einzelnes Anführungszeichen; jede Überschrift in eine Zeile schreiben, wie {example}</translation>
    </message>
    <message>
        <source>{where}: heading {heading} is not &apos;axis.channel [unit]&apos;; write it like {example}, and begin lines above the header with &apos;#&apos;</source>
        <translation>{where}: Überschrift {heading} ist nicht &apos;Achse.Kanal [Einheit]&apos;; wie {example} schreiben und Zeilen über der Kopfzeile mit &apos;#&apos; beginnen</translation>
    </message>
    <message>
        <source>{where}: unknown channel {tap} in {name}; use one of {names}</source>
        <translation>{where}: unbekannter Kanal {tap} in {name}; möglich: {names}</translation>
    </message>
    <message>
        <source>{where}: {axis} cannot name an axis; begin with a letter, and use no separators, brackets, quotes or &apos;#&apos; and at most {longest_name} characters</source>
        <translation>{where}: {axis} kann keine Achse benennen; mit einem Buchstaben beginnen, keine Trennzeichen, Klammern, Anführungszeichen oder &apos;#&apos; und höchstens {longest_name} Zeichen verwenden</translation>
    </message>
    <message>
        <source>{where}: {value} cannot be in [{unit}]; use a unit of {names}</source>
        <translation>{where}: {value} kann nicht in [{unit}] sein; eine Einheit aus {names} verwenden</translation>
    </message>
    <message>
        <source>{where}:{number}: column {column} is already column {before}; remove one</source>
        <translation>{where}:{number}: Spalte {column} ist schon Spalte {before}; eine entfernen</translation>
    </message>
    <message>
        <source>{where}: no column except time; add one, such as {example}</source>
        <translation>{where}: keine Spalte außer der Zeit; eine hinzufügen, wie {example}</translation>
    </message>
    <message>
        <source>{where}:{number}: {column} is in [{unit}], but an earlier column of {axis} is in units of {kind}; correct one of them</source>
        <translation>{where}:{number}: {column} ist in [{unit}], aber eine frühere Spalte von {axis} in Einheiten von {kind}; eine von beiden korrigieren</translation>
    </message>
    <message>
        <source>{where}: axis {quoted} has {axis}.{tap} but no {axis}.cmd; add it</source>
        <translation>{where}: Achse {quoted} hat {axis}.{tap}, aber kein {axis}.cmd; hinzufügen</translation>
    </message>
    <message>
        <source>{where}:{number}: robot {name} has no axis {axis}; its axes are {names}</source>
        <translation>{where}:{number}: Roboter {name} hat keine Achse {axis}; seine Achsen sind {names}</translation>
    </message>
    <message>
        <source>{where}:{number}: {column} is in [{unit}] but robot {name} moves {axis} in units of {kind}; correct the unit</source>
        <translation>{where}:{number}: {column} ist in [{unit}], aber Roboter {name} bewegt {axis} in Einheiten von {kind}; die Einheit berichtigen</translation>
    </message>
    <message>
        <source>{fspath}:{first_line}: more than {values} values; split the file</source>
        <translation>{fspath}:{first_line}: mehr als {values} Werte; die Datei teilen</translation>
    </message>
    <message>
        <source>{name}:{first_line}: no rows of numbers; the record is empty</source>
        <translation>{name}:{first_line}: keine Zeilen mit Zahlen; die Aufzeichnung ist leer</translation>
    </message>
    <message>
        <source>{name}:{line}: too many bytes of comments; shorten them</source>
        <translation>{name}:{line}: insgesamt zu viele Byte an Kommentaren; kürzen</translation>
    </message>
    <message>
        <source>{name}:{line}: the row begins with a spreadsheet&apos;s mark of a missing value or an error; write its time, or delete the row</source>
        <translation>{name}:{line}: Die Zeile beginnt mit dem Zeichen einer Tabellenkalkulation für einen fehlenden Wert oder Fehler; die Zeit eintragen oder die Zeile löschen</translation>
    </message>
    <message>
        <source>{name}:{line}: no header and no rows of numbers; the record is empty</source>
        <translation>{name}:{line}: keine Kopfzeile und keine Zeilen mit Zahlen; die Aufzeichnung ist leer</translation>
    </message>
    <message>
        <source>{where}: the line states the separator {separator}; use a semicolon, comma, tab or blank</source>
        <translation>{where}: Die Zeile nennt das Trennzeichen {separator}; Semikolon, Komma, Tabulator oder Leerzeichen verwenden</translation>
    </message>
    <message>
        <source>{where}: the line above states the separator {separator}, but the header uses {other}; correct one of them</source>
        <translation>{where}: Die Zeile darüber nennt das Trennzeichen {separator}, die Kopfzeile verwendet aber {other}; eine von beiden korrigieren</translation>
    </message>
    <message>
        <source>{where}:{index}: the header has {found}, but you named {asked}; use the same name, or omit it</source>
        <translation>{where}:{index}: Die Kopfzeile hat {found}, angegeben wurde aber {asked}; dasselbe angeben oder die Angabe weglassen</translation>
    </message>
    <message>
        <source>{where}:1: the file has no header row; name its columns, such as &apos;{example}&apos;</source>
        <translation>{where}:1: die Datei hat keine Kopfzeile; ihre Spalten benennen, etwa &apos;{example}&apos;</translation>
    </message>
    <message>
        <source>{name}: there are no shipped models of this name; choose from {names}</source>
        <translation>{name}: Es gibt keine mitgelieferten Modelle dieses Namens; möglich: {names}</translation>
    </message>
    <message>
        <source>{source}: not valid TOML: {error}</source>
        <translation>{source}: kein gültiges TOML: {error}</translation>
    </message>
    <message>
        <source>{source}: {describe}</source>
        <translation>{source}: {describe}</translation>
    </message>
    <message>
        <source>{source}: model.{name}: {count} coefficients over {denominator}; the denominator must begin with 1 and be at least as long</source>
        <translation>{source}: model.{name}: {count} Koeffizienten über {denominator}; der Nenner beginnt mit 1 und ist mindestens so lang</translation>
    </message>
    <message>
        <source>reading {variable}: choose &apos;s&apos; or &apos;z&apos;</source>
        <translation>Lesart {variable}: &apos;s&apos; oder &apos;z&apos; wählen</translation>
    </message>
    <message>
        <source>{source}: axis.{name}.effect: must be tables, each headed [[axis.{name}.effect]]</source>
        <translation>{source}: axis.{name}.effect: müssen Tabellen sein, jede mit der Überschrift [[axis.{name}.effect]]</translation>
    </message>
    <message>
        <source>{source}: {error}</source>
        <translation>{source}: {error}</translation>
    </message>
    <message>
        <source>must name at least one axis</source>
        <translation>muss mindestens eine Achse nennen</translation>
    </message>
    <message>
        <source>must name each axis once</source>
        <translation>muss jede Achse genau einmal nennen</translation>
    </message>
    <message>
        <source>needs a table [axis.{name}]</source>
        <translation>braucht eine Tabelle [axis.{name}]</translation>
    </message>
    <message>
        <source>must be listed in robot.axes {names}</source>
        <translation>muss in robot.axes {names} stehen</translation>
    </message>
    <message>
        <source>{path}: no such robot file, and no shipped robot of that name (shipped: {known})</source>
        <translation>{path}: diese Roboterdatei gibt es nicht, auch keinen mitgelieferten Roboter dieses Namens (mitgeliefert: {known})</translation>
    </message>
    <message>
        <source>{source}: no [[axis.NAME.effect]] can be added ({error}); write axes and effects as sections of their own</source>
        <translation>{source}: kein [[axis.NAME.effect]] kann hinzukommen ({error}); Achsen und Effekte als eigene Abschnitte schreiben</translation>
    </message>
    <message>
        <source>{name} already exists; name another file</source>
        <translation>{name}: gibt es schon; eine andere Datei angeben</translation>
    </message>
    <message>
        <source>{source}: would not read back to the same {names}</source>
        <translation>{source}: ergäbe beim Lesen nicht dasselbe {names}</translation>
    </message>
    <message>
        <source>{key} = {value}: {bound}</source>
        <translation>{key} = {value}: {bound}</translation>
    </message>
    <message>
        <source>the first value must be below the second</source>
        <translation>der erste Wert muss kleiner als der zweite sein</translation>
    </message>
    <message>
        <source>must be below the range&apos;s {span}</source>
        <translation>muss kleiner als die Spanne {span} des Bereichs sein</translation>
    </message>
    <message>
        <source>must be at most the range&apos;s {span}</source>
        <translation>darf höchstens die Spanne {span} des Bereichs sein</translation>
    </message>
    <message>
        <source>an axis of kind &apos;force&apos; is a mass and cannot be static</source>
        <translation>eine Achse der Art &apos;force&apos; ist eine Masse und kann nicht statisch sein</translation>
    </message>
    <message>
        <source>a static axis has no dynamics; remove it</source>
        <translation>eine statische Achse hat keine Dynamik; entfernen</translation>
    </message>
    <message>
        <source>give mass, damping, stiffness or the natural frequency, not both</source>
        <translation>Masse, Dämpfung, Steifigkeit oder die Eigenfrequenz angeben, nicht beides</translation>
    </message>
    <message>
        <source>{given_modal} needs it</source>
        <translation>{given_modal} braucht es</translation>
    </message>
    <message>
        <source>an axis of kind {kind} needs it</source>
        <translation>eine Achse der Art {kind} braucht es</translation>
    </message>
    <message>
        <source>{names} go together</source>
        <translation>{names} gehören zusammen</translation>
    </message>
    <message>
        <source>must not be zero</source>
        <translation>darf nicht null sein</translation>
    </message>
    <message>
        <source>a static axis has nothing to control</source>
        <translation>eine statische Achse hat nichts zu regeln</translation>
    </message>
    <message>
        <source>must be at most {largest} V, the end of voltage_range</source>
        <translation>darf höchstens {largest} V sein, das Ende von voltage_range</translation>
    </message>
    <message>
        <source>gain {gain} over voltage_range {ends} reaches only {low} to {high}</source>
        <translation>gain {gain} über voltage_range {ends} reicht nur von {low} bis {high}</translation>
    </message>
    <message>
        <source>must be one of {names}</source>
        <translation>muss eines von {names} sein</translation>
    </message>
    <message>
        <source>is in stage {seen} already</source>
        <translation>ist schon in Stufe {seen}</translation>
    </message>
    <message>
        <source>a static axis has no dynamics to couple</source>
        <translation>eine statische Achse hat keine Dynamik zu koppeln</translation>
    </message>
    <message>
        <source>must name two different axes</source>
        <translation>muss zwei verschiedene Achsen nennen</translation>
    </message>
    <message>
        <source>couples these axes in {matrix} a second time</source>
        <translation>koppelt diese Achsen in {matrix} ein zweites Mal</translation>
    </message>
    <message>
        <source>{letter} must be positive {word}; make the coupling smaller</source>
        <translation>{letter} muss positiv {word} sein; die Kopplung verkleinern</translation>
    </message>
    <message>
        <source>must be greater than {gt}</source>
        <translation>muss größer als {gt} sein</translation>
    </message>
    <message>
        <source>must be at least {ge}</source>
        <translation>muss mindestens {ge} sein</translation>
    </message>
    <message>
        <source>must be less than {lt}</source>
        <translation>muss kleiner als {lt} sein</translation>
    </message>
    <message>
        <source>must be at most {le}</source>
        <translation>darf höchstens {le} sein</translation>
    </message>
    <message>
        <source>must be a finite number</source>
        <translation>muss eine endliche Zahl sein</translation>
    </message>
    <message>
        <source>must be a number</source>
        <translation>muss eine Zahl sein</translation>
    </message>
    <message>
        <source>must be a whole number</source>
        <translation>muss eine ganze Zahl sein</translation>
    </message>
    <message>
        <source>must be true or false</source>
        <translation>muss true oder false sein</translation>
    </message>
    <message>
        <source>must be text</source>
        <translation>muss Text sein</translation>
    </message>
    <message>
        <source>must not be empty</source>
        <translation>darf nicht leer sein</translation>
    </message>
    <message>
        <source>must have at most {max_length} letters</source>
        <translation>darf höchstens {max_length} Buchstaben haben</translation>
    </message>
    <message>
        <source>must be {expected}</source>
        <translation>muss {expected} sein</translation>
    </message>
    <message>
        <source>must have at least {min_length} entry</source>
        <translation>muss mindestens {min_length} Eintrag haben</translation>
    </message>
    <message>
        <source>must have {max_length} entries, has {actual_length}</source>
        <translation>muss {max_length} Einträge haben, hat {actual_length}</translation>
    </message>
    <message>
        <source>must be a list</source>
        <translation>muss eine Liste sein</translation>
    </message>
    <message>
        <source>must be a table</source>
        <translation>muss eine Tabelle sein</translation>
    </message>
    <message>
        <source>{problem} (and {count} more)</source>
        <translation>{problem} (und {count} weitere)</translation>
    </message>
    <message>
        <source>did you mean {key}?</source>
        <translation>war {key} gemeint?</translation>
    </message>
    <message>
        <source>known here: {keys}</source>
        <translation>hier bekannt: {keys}</translation>
    </message>
    <message>
        <source>{key}.kind: missing; one of {kinds}</source>
        <translation>{key}.kind: fehlt; eines von {kinds}</translation>
    </message>
    <message>
        <source>{key}.kind = {value}: must be one of {kinds}</source>
        <translation>{key}.kind = {value}: muss eines von {kinds} sein</translation>
    </message>
    <message>
        <source>input shaping for {frequency_hz} Hz and a damping ratio of {damping_ratio}: the frequency must be positive, the ratio at least 0 and less than 1</source>
        <translation>Impulsformung für {frequency_hz} Hz und Dämpfungsgrad {damping_ratio}: die Frequenz muss positiv, der Dämpfungsgrad mindestens 0 und kleiner als 1 sein</translation>
    </message>
    <message>
        <source>input shaping of order {order}: must be 1 (ZV) to {most_order}</source>
        <translation>Impulsformung der Ordnung {order}: 1 (ZV) bis {most_order}</translation>
    </message>
    <message>
        <source>{name} limit of a move: {value}: must be more than 0</source>
        <translation>Grenze {name} einer Bewegung: {value}: muss größer als 0 sein</translation>
    </message>
    <message>
        <source>S-curve: ramp {ramp}, rounding {rounding}: must be more than 0, and at most 0.5 and 1</source>
        <translation>S-Kurve: Rampe {ramp}, Verrundung {rounding}: größer als 0, höchstens 0,5 und 1</translation>
    </message>
    <message>
        <source>a minimum-jerk move needs a limit of speed, acceleration or jerk</source>
        <translation>eine ruckminimale Bewegung braucht eine Grenze für Geschwindigkeit, Beschleunigung oder Ruck</translation>
    </message>
    <message>
        <source>profile table: {size} times and {values_size} positions: both numbers must be equal, 2 to {most_rows}</source>
        <translation>Profiltabelle: {size} Zeiten und {values_size} Positionen: Beide Anzahlen müssen gleich sein, 2 bis {most_rows}</translation>
    </message>
    <message>
        <source>profile table, row {row}: {times} s, {values}: numbers must be finite, and times must rise from row to row</source>
        <translation>Profiltabelle, Zeile {row}: {times} s, {values}: Zahlen müssen endlich sein, und Zeiten müssen von Zeile zu Zeile steigen</translation>
    </message>
    <message>
        <source>profile table, row 1: {times} s, {values}: it must begin at 0, 0</source>
        <translation>Profiltabelle, Zeile 1: {times} s, {values}: muss bei 0, 0 beginnen</translation>
    </message>
    <message>
        <source>profile table, row {count}: it ends where it began</source>
        <translation>Profiltabelle, Zeile {count}: endet, wo sie begann</translation>
    </message>
    <message>
        <source>profile: distance {distance}: must be finite and not zero</source>
        <translation>Profil: ein Weg von {distance}: muss endlich und nicht null sein</translation>
    </message>
    <message>
        <source>profile: duration {duration_s} s: must be finite and positive</source>
        <translation>Profil: eine Dauer von {duration_s} s: muss endlich und positiv sein</translation>
    </message>
    <message>
        <source>shape: {shape} times for coefficients {values_shape}</source>
        <translation>Form: {shape} Zeiten für Koeffizienten {values_shape}</translation>
    </message>
    <message>
        <source>shape: times and coefficients must be finite</source>
        <translation>Form: Zeiten und Koeffizienten müssen endlich sein</translation>
    </message>
    <message>
        <source>shape: times must rise from 0 s</source>
        <translation>Form: Zeiten müssen ab 0 s steigen</translation>
    </message>
    <message>
        <source>profile: {most_pieces} cubics leave an error of {error}, more than {most_error} (SI units); choose a smoother profile, or input shaping of a lower order</source>
        <translation>Profil: {most_pieces} kubische Stücke lassen einen Fehler von {error}, höchstens {most_error} (SI-Einheiten); ein glatteres wählen oder Impulsformung niedrigerer Ordnung</translation>
    </message>
    <message>
        <source>feed-forward: the acceleration of the profile jumps by {jump} (SI units), with a maximum of {greatest}; use an S-curve or minimum jerk, or input shaping</source>
        <translation>Vorsteuerung: die Beschleunigung des Profils springt um {jump} (SI-Einheiten), höchstens {greatest}; eine S-Kurve, minimalen Ruck oder Impulsformung verwenden</translation>
    </message>
    <message>
        <source>{name} {value}: must be {least} to {most}</source>
        <translation>{name} {value}: muss {least} bis {most} sein</translation>
    </message>
    <message>
        <source>axis {axis}: a loop at {rate_hz} Hz is too slow for a resonance at {frequency_hz} Hz; use a rate above {least_hz} Hz</source>
        <translation>Achse {axis}: ein Regelkreis mit {rate_hz} Hz ist zu langsam für eine Resonanz bei {frequency_hz} Hz; eine Rate über {least_hz} Hz nehmen</translation>
    </message>
    <message>
        <source>{name} of {length}: must be no more than the axis&apos; range, {most}, and not zero</source>
        <translation>{name} von {length}: darf höchstens der Bereich der Achse sein, {most}, und nicht null</translation>
    </message>
    <message>
        <source>point {number}: the front has points 0 to {count}; choose one</source>
        <translation>Punkt {number}: die Front hat die Punkte 0 bis {count}; einen davon wählen</translation>
    </message>
    <message>
        <source>axis {axis}: after {done} generations no gains meet Ms ≤ {peak_sensitivity} and overshoot ≤ {overshoot} %; search longer, use a faster loop, or relax the limits</source>
        <translation>Achse {axis}: Nach {done} Generationen erfüllen keine Verstärkungen Ms ≤ {peak_sensitivity} und Überschwingen ≤ {overshoot} %; suchen Sie länger, verwenden Sie einen schnelleren Regelkreis oder lockern Sie die Grenzen</translation>
    </message>
    <message>
        <source>{name}: {key} = {value}: {reason}</source>
        <translation>{name}: {key} = {value}: {reason}</translation>
    </message>
    <message>
        <source>{name}: {key} = {value}: the file has points 0 to {last}</source>
        <translation>{name}: {key} = {value}: die Datei hat die Punkte 0 bis {last}</translation>
    </message>
    <message>
        <source>unknown unit {unit}; use one of {known}</source>
        <translation>unbekannte Einheit {unit}; möglich: {known}</translation>
    </message>
    <message>
        <source>{si_unit} is not an SI unit of a record; use one of {names}</source>
        <translation>{si_unit} ist keine SI-Einheit einer Aufzeichnung; möglich: {names}</translation>
    </message>
    <message>
        <source>image: its shape is {shape}; must be (rows, columns) or (rows, columns, 3), at least {least_side} px each way</source>
        <translation>Bild: seine Form ist {shape}; muss (Zeilen, Spalten) oder (Zeilen, Spalten, 3) sein, mindestens {least_side} px je Richtung</translation>
    </message>
    <message>
        <source>image: a pixel is not a finite number; the camera&apos;s data are damaged</source>
        <translation>Bild: ein Bildpunkt ist keine endliche Zahl; die Daten der Kamera sind beschädigt</translation>
    </message>
    <message>
        <source>image: every pixel is {low}; the camera is dark, saturated or covered: check lamp, shutter and exposure</source>
        <translation>Bild: jeder Bildpunkt ist {low}; die Kamera ist dunkel, übersteuert oder abgedeckt: Lampe, Verschluss und Belichtung prüfen</translation>
    </message>
    <message>
        <source>background: {columns} × {rows} px against an image of {image_columns} × {image_rows} px; take it again with this camera setting</source>
        <translation>Hintergrund: {columns} × {rows} px gegen ein Bild von {image_columns} × {image_rows} px; mit dieser Kameraeinstellung neu aufnehmen</translation>
    </message>
    <message>
        <source>pipette: {name} = {value} px: must be more than 0</source>
        <translation>Pipette: {name} = {value} px: muss größer als 0 sein</translation>
    </message>
    <message>
        <source>pipette: its angle to the focal plane is {angle}°, must be at most {most}°; seen from its end it has no recognisable shape: tilt the view</source>
        <translation>Pipette: sie steht {angle}° zur Fokusebene, höchstens {most}°; von der Spitze her gesehen hat sie keine erkennbare Form: die Ansicht neigen</translation>
    </message>
    <message>
        <source>{name} is a folder; name a file in it</source>
        <translation>{name}: das ist ein Ordner; eine Datei darin angeben</translation>
    </message>
    <message>
        <source>{name} is a device, not a file; name a file</source>
        <translation>{name}: das ist ein Gerät und keine Datei; eine Datei angeben</translation>
    </message>
    <message>
        <source>{name} cannot be written ({reason}); choose another folder, or free disk space</source>
        <translation>{name} kann nicht geschrieben werden ({reason}); einen anderen Ordner wählen oder Platz schaffen</translation>
    </message>
    <message>
        <source>A, accuracy</source>
        <translation>A, Genauigkeit</translation>
    </message>
    <message>
        <source>R, repeatability</source>
        <translation>R, Wiederholgenauigkeit</translation>
    </message>
    <message>
        <source>B, reversal value</source>
        <translation>B, Umkehrspanne</translation>
    </message>
    <message>
        <source>B̄, mean reversal</source>
        <translation>B̄, mittlere Umkehrspanne</translation>
    </message>
    <message>
        <source>E, systematic deviation</source>
        <translation>E, systematische Abweichung</translation>
    </message>
    <message>
        <source>M, mean bidirectional deviation</source>
        <translation>M, mittlere beidseitige Abweichung</translation>
    </message>
    <message>
        <source>{name}: {axis}: laser and sensor can be compared in {kept} of {count} rows, {least_kept} are needed ({losses}); align the laser and record again</source>
        <translation>{name}: {axis}: Laser und Sensor sind in {kept} von {count} Zeilen vergleichbar, nötig sind {least_kept} ({losses}); den Laser ausrichten und neu aufzeichnen</translation>
    </message>
    <message>
        <source>the rest is in short pieces</source>
        <translation>der Rest besteht aus kurzen Stücken</translation>
    </message>
    <message>
        <source>the robot</source>
        <translation>der Roboter</translation>
    </message>
    <message>
        <source>{name}: axis {axis}: {whose} has {names}; choose one</source>
        <translation>{name}: Achse {axis}: {whose} hat {names}; eine davon wählen</translation>
    </message>
    <message>
        <source>the axis&apos; own sensor</source>
        <translation>der eigene Sensor der Achse</translation>
    </message>
    <message>
        <source>a laser</source>
        <translation>ein Laser</translation>
    </message>
    <message>
        <source>{name}: there is no column {axis}.{tap}, the reading of {what}; it has {names}; record with the laser, or join its file</source>
        <translation>{name}: es fehlt die Spalte {axis}.{tap}, die Messwerte von: {what}; vorhanden: {names}; mit dem Laser aufzeichnen oder seine Datei verbinden</translation>
    </message>
    <message>
        <source>{name}: {count} rows; a calibration needs at least {least_rows}</source>
        <translation>{name}: {count} Zeilen; eine Kalibrierung braucht mindestens {least_rows}</translation>
    </message>
    <message>
        <source>{name}: according to the laser {axis} travels {travel}, {share} of its range; a calibration needs {least_share}, which is {least}; move the axis farther</source>
        <translation>{name}: laut Laser fährt {axis} {travel}, das sind {share} ihres Bereichs; eine Kalibrierung braucht {least_share}, also {least}; die Achse weiter fahren</translation>
    </message>
    <message>
        <source>the laser was lost from {begin} s to {end} s</source>
        <translation>der Laser war von {begin} s bis {end} s verloren</translation>
    </message>
    <message>
        <source>no rows from {begin} s to {end} s</source>
        <translation>keine Zeilen von {begin} s bis {end} s</translation>
    </message>
    <message>
        <source>record: there is no column {axis}.meas to match with the laser</source>
        <translation>Aufzeichnung: es fehlt die Spalte {axis}.meas, zu der die des Lasers kommen soll</translation>
    </message>
    <message>
        <source>laser: there is no column {axis}.ref; it has {names}</source>
        <translation>Laser: es fehlt die Spalte {axis}.ref; vorhanden: {names}</translation>
    </message>
    <message>
        <source>laser: its motion does not match that of {axis} in the record at any shift of the clocks; use the files of one run</source>
        <translation>Laser: seine Bewegung und die von {axis} in der Aufzeichnung gleichen sich bei keiner Verschiebung der Uhren; Dateien eines Laufs verbinden</translation>
    </message>
    <message>
        <source>a record of less than 20 ms cannot be matched with another</source>
        <translation>eine Aufzeichnung von weniger als 20 ms lässt sich mit keiner anderen verbinden</translation>
    </message>
    <message>
        <source>the zero drifts by {drift} rms during the runs: it depends on time, not on the axis, and no calibration removes it; warm up, or calibrate often</source>
        <translation>der Nullpunkt driftet während der Läufe um {drift} rms: er hängt von der Zeit ab, nicht von der Achse, und keine Kalibrierung beseitigt das; aufwärmen oder oft kalibrieren</translation>
    </message>
    <message>
        <source>deviations have shape {shape}; ISO 230-2 needs (targets, runs, 2)</source>
        <translation>die Abweichungen haben die Form {shape}; ISO 230-2 braucht (Ziele, Läufe, 2)</translation>
    </message>
    <message>
        <source>each target was approached {shape} times from each side; ISO 230-2 needs {iso_runs} runs; a standard deviation needs at least {least_runs}</source>
        <translation>jedes Ziel wurde {shape}-mal von jeder Seite angefahren; ISO 230-2 verlangt {iso_runs} Läufe; eine Standardabweichung braucht mindestens {least_runs}</translation>
    </message>
    <message>
        <source>{axis}: in the runs left out of the fit the reading&apos;s error is {after} rms with the calibration and {before} without; the calibration is not better and is not used</source>
        <translation>{axis}: bei zurückgehaltenen Läufen ist der Fehler des Messwerts {after} rms mit der Kalibrierung und {before} ohne; sie ist nicht besser und wird nicht genutzt</translation>
    </message>
    <message>
        <source>only {count} runs have {least_run_rows} rows or more; a calibration needs {least_runs}, because each run is held out once; make a longer record</source>
        <translation>nur {count} Läufe haben {least_run_rows} Zeilen oder mehr; eine Kalibrierung braucht {least_runs}, weil jeder Lauf einmal zurückgehalten wird; länger aufzeichnen</translation>
    </message>
    <message>
        <source>offset</source>
        <translation>Versatz</translation>
    </message>
    <message>
        <source>gain error</source>
        <translation>Verstärkungsfehler</translation>
    </message>
    <message>
        <source>nonlinearity</source>
        <translation>Nichtlinearität</translation>
    </message>
    <message>
        <source>hysteresis</source>
        <translation>Hysterese</translation>
    </message>
    <message>
        <source>interpolation error</source>
        <translation>Interpolationsfehler</translation>
    </message>
    <message>
        <source>its period</source>
        <translation>seine Periode</translation>
    </message>
    <message>
        <source>time constant</source>
        <translation>Zeitkonstante</translation>
    </message>
    <message>
        <source>delay</source>
        <translation>Totzeit</translation>
    </message>
    <message>
        <source>lag, {name}</source>
        <translation>Nachlauf, {name}</translation>
    </message>
    <message>
        <source>the runs have no measured channel in common: {measured} and {measured_other}</source>
        <translation>die Läufe haben keinen gemessenen Kanal gemeinsam: {measured} und {measured_other}</translation>
    </message>
    <message>
        <source>axis {axis} is in {unit} in one run and in {other_unit} in the other; the runs are from different machines</source>
        <translation>Achse {axis} steht im einen Lauf in {unit}, im anderen in {other_unit}; das ist nicht dieselbe Maschine</translation>
    </message>
    <message>
        <source>--fit: {name} cannot be re-fitted; choose from {names}</source>
        <translation>--fit: {name} lässt sich nicht neu anpassen; möglich: {names}</translation>
    </message>
    <message>
        <source>the record holds no measured channel (u, ref or meas) to compare; it has {names}</source>
        <translation>die Aufzeichnung enthält keinen gemessenen Kanal (u, ref oder meas) zum Vergleichen; vorhanden: {names}</translation>
    </message>
    <message>
        <source>{path}: the name of a picture must end in {names}</source>
        <translation>{path}: der Name eines Bildes endet auf {names}</translation>
    </message>
    <message>
        <source>friction: a static axis has no motion to damp; give it mass and damping</source>
        <translation>friction: eine statische Achse hat keine Bewegung zu dämpfen; ihr Masse und Dämpfung geben</translation>
    </message>
    <message>
        <source>{where}: the robot has no such axis; it has {axes}</source>
        <translation>{where}: der Roboter hat keine solche Achse; vorhanden: {axes}</translation>
    </message>
    <message>
        <source>{where}.id = {effect_id}: must be the id of an effect, a text</source>
        <translation>{where}.id = {effect_id}: muss die Kennung eines Effekts sein, ein Text</translation>
    </message>
    <message>
        <source>{where}.{key} = {text}: must be a text</source>
        <translation>{where}.{key} = {text}: muss ein Text sein</translation>
    </message>
    <message>
        <source>{where}.enabled = {enabled}: must be true or false</source>
        <translation>{where}.enabled = {enabled}: muss true oder false sein</translation>
    </message>
    <message>
        <source>{where}.{key} = {value}: must be a number</source>
        <translation>{where}.{key} = {value}: muss eine Zahl sein</translation>
    </message>
    <message>
        <source>{where}.formulation = {name}: must be one of {known}</source>
        <translation>{where}.formulation = {name}: muss eine von {known} sein</translation>
    </message>
    <message>
        <source>{where}{what}: acts on axes of kind {names}; this one is of kind {kind}</source>
        <translation>{where}{what}: gehört zu Achsen der Art {names}; diese ist von der Art {kind}</translation>
    </message>
    <message>
        <source>{where}: formulation {name} acts on the dynamics of an axis, but this one is static; give it mass, damping and stiffness, or choose another formulation</source>
        <translation>{where}: Formulierung {name} wirkt auf die Dynamik einer Achse, und diese ist statisch; ihr Masse, Dämpfung und Steifigkeit geben oder eine andere Formulierung wählen</translation>
    </message>
    <message>
        <source>{where}.from_axis = {from_axis}: no other axis causes this effect; remove from_axis</source>
        <translation>{where}.from_axis = {from_axis}: diesen Effekt verursacht keine andere Achse; from_axis entfernen</translation>
    </message>
    <message>
        <source>{where}.from_axis = {from_axis}: must be one of {others}</source>
        <translation>{where}.from_axis = {from_axis}: muss eine von {others} sein</translation>
    </message>
    <message>
        <source>{where}.{name} = {beyond}</source>
        <translation>{where}.{name} = {beyond}</translation>
    </message>
    <message>
        <source>there is no effect {effect_id}; {meant}available: {known}</source>
        <translation>den Effekt {effect_id} gibt es nicht; {meant}vorhanden: {known}</translation>
    </message>
    <message>
        <source>effect {effect_id} ({value}) is not an Effect</source>
        <translation>Effekt {effect_id} ({value}) ist kein Effect</translation>
    </message>
    <message>
        <source>effect {effect_id}: {error}</source>
        <translation>Effekt {effect_id}: {error}</translation>
    </message>
    <message>
        <source>effect {effect_id} ({value}) has the id {id}</source>
        <translation>Effekt {effect_id} ({value}) nennt sich selbst {id}</translation>
    </message>
    <message>
        <source>effect {effect_id} ({value}) has no formulation</source>
        <translation>Effekt {effect_id} ({value}) hat keine Formulierung</translation>
    </message>
    <message>
        <source>flexible_mode: formulation &apos;appendage&apos; pulls on the mass of an axis, but this axis is static; give it mass, damping and stiffness, or choose another formulation</source>
        <translation>flexible_mode: Formulierung &apos;appendage&apos; zieht an der Masse einer Achse, und diese ist statisch; ihr Masse, Dämpfung und Steifigkeit geben oder eine andere Formulierung wählen</translation>
    </message>
    <message>
        <source>resonance_mismatch: nothing holds this axis, so it has no resonance; give it mass, damping and stiffness, or remove the effect</source>
        <translation>resonance_mismatch: diese Achse wird von nichts gehalten und hat deshalb keine Resonanz; ihr Masse, Dämpfung und Steifigkeit geben oder den Effekt entfernen</translation>
    </message>
    <message>
        <source>simulation: the model is sampled at {rate_hz} Hz, the record at {signals_rate_hz} Hz; resample the record</source>
        <translation>Simulation: das Modell ist mit {rate_hz} Hz abgetastet, die Aufzeichnung mit {signals_rate_hz} Hz; die Aufzeichnung neu abtasten</translation>
    </message>
    <message>
        <source>{orders}: poles and delay cannot be negative, and the numerator needs at least one coefficient</source>
        <translation>{orders}: Pole und Totzeit können nicht negativ sein, und der Zähler braucht mindestens einen Koeffizienten</translation>
    </message>
    <message>
        <source>signals: {inputs} samples, but {orders} needs at least {needed}; record longer or choose lower orders</source>
        <translation>Signale: {inputs} Abtastwerte, {orders} braucht mindestens {needed}; länger aufzeichnen oder niedrigere Ordnungen wählen</translation>
    </message>
    <message>
        <source>{what}: the record does not determine all {count} parameters (singular values {least} to {most}, bound {bound}); choose lower orders or excite more frequencies</source>
        <translation>{what}: die Aufzeichnung bestimmt nicht alle {count} Parameter (Singulärwerte {least} bis {most}, Grenze {bound}); niedrigere Ordnungen wählen oder mehr Frequenzen anregen</translation>
    </message>
    <message>
        <source>{name} {values}: must be a row of finite coefficients</source>
        <translation>{name} {values}: braucht endliche Koeffizienten in einer Reihe</translation>
    </message>
    <message>
        <source>denominator: must begin with 1, not {denominator}</source>
        <translation>Nenner: beginnt mit {denominator}; muss 1 sein</translation>
    </message>
    <message>
        <source>delay {delay} samples: cannot be negative</source>
        <translation>Totzeit {delay} Abtastwerte: kann nicht negativ sein</translation>
    </message>
    <message>
        <source>rate {rate_hz} Hz: use a positive number</source>
        <translation>Rate {rate_hz} Hz: eine positive Zahl verwenden</translation>
    </message>
    <message>
        <source>resonance: band {band_hz} Hz; the lower frequency must come first</source>
        <translation>Resonanz: Band {band_hz} Hz; die niedrigere Frequenz muss zuerst stehen</translation>
    </message>
    <message>
        <source>resonance: {count} lines from {low_hz} to {high_hz} Hz; at least {least_lines} are needed, widen the band or increase the resolution</source>
        <translation>Resonanz: {count} Linien von {low_hz} bis {high_hz} Hz; mindestens {least_lines} sind nötig, verbreitern Sie das Band oder erhöhen Sie die Auflösung</translation>
    </message>
    <message>
        <source>resonance: the response is zero over the band</source>
        <translation>Resonanz: die Antwort ist über das ganze Band null</translation>
    </message>
    <message>
        <source>resonance: the best fit lies at {frequency_hz} Hz with damping {damping}, no peak inside the band {low_hz} to {high_hz} Hz; choose a band around a peak</source>
        <translation>Resonanz: die beste Anpassung liegt bei {frequency_hz} Hz mit Dämpfung {damping}, keine Spitze im Band {low_hz} bis {high_hz} Hz; ein Band um eine Spitze wählen</translation>
    </message>
    <message>
        <source>Welch: {averages} independent segments of {segment} samples for {inputs} inputs; at least {least} are needed, use shorter segments or longer records</source>
        <translation>Welch: {averages} unabhängige Segmente von {segment} Abtastwerten für {inputs} Eingänge; mindestens {least} sind nötig, kürzere Segmente oder längere Aufzeichnungen verwenden</translation>
    </message>
    <message>
        <source>Welch: segments of {segment} samples; use {shortest} or more</source>
        <translation>Welch: Segmente von {segment} Abtastwerten; {shortest} oder mehr verwenden</translation>
    </message>
    <message>
        <source>Welch: overlap {overlap} is not in [0, 1); use 0.5</source>
        <translation>Welch: Überlappung {overlap} ist nicht in [0, 1); 0.5 verwenden</translation>
    </message>
    <message>
        <source>experiments: none given; at least one is needed</source>
        <translation>Experimente: keines angegeben; mindestens eines ist nötig</translation>
    </message>
    <message>
        <source>experiment {number}: {inputs} → {outputs} at {rate_hz} Hz, but the first has {first_inputs} → {first_outputs} at {first_rate_hz} Hz; all must be equal</source>
        <translation>Experiment {number}: {inputs} → {outputs} mit {rate_hz} Hz, das erste hat {first_inputs} → {first_outputs} mit {first_rate_hz} Hz; alle müssen gleich sein</translation>
    </message>
    <message>
        <source>inputs: on no line are all {count} excited independently with at least {excited_above} of the largest amplitude; excite them one after another, with independent signals, or in as many experiments as there are inputs</source>
        <translation>Eingänge: Auf keiner Linie sind alle {count} unabhängig mit mindestens {excited_above} der größten Amplitude angeregt; regen Sie sie nacheinander, mit unabhängigen Signalen oder in so vielen Experimenten an, wie es Eingänge gibt</translation>
    </message>
    <message>
        <source>periodic response: a period of {period} samples, {skip_periods} periods skipped; the record needs &apos;# history: periodic&apos; and &apos;# period_samples: N&apos;</source>
        <translation>periodische Antwort: eine Periode von {period} Abtastwerten, {skip_periods} Perioden übersprungen; die Aufzeichnung braucht &apos;# history: periodic&apos; und &apos;# period_samples: N&apos;</translation>
    </message>
    <message>
        <source>periodic response: {periods} whole periods of {period} samples after {skip_periods} skipped; the noise needs at least 2</source>
        <translation>periodische Antwort: {periods} ganze Perioden von {period} Abtastwerten nach {skip_periods} übersprungenen; das Rauschen braucht mindestens 2</translation>
    </message>
    <message>
        <source>experiments: periods of {periods} samples; all must be equal</source>
        <translation>Experimente: Perioden von {periods} Abtastwerten; alle müssen gleich sein</translation>
    </message>
    <message>
        <source>loops: {inputs} samples of input, {outputs} of output, {lag_samples} of lag; input and output must be equally long, with at least three samples left</source>
        <translation>Schleifen: {inputs} Abtastwerte des Eingangs, {outputs} des Ausgangs, {lag_samples} Nachlauf; gleich viele und mindestens drei sind nötig</translation>
    </message>
    <message>
        <source>loops: lag of {lag_samples} samples, minimum swing {least_swing}; the lag must be 0 or more, the swing in (0, 1)</source>
        <translation>Schleifen: Nachlauf von {lag_samples} Abtastwerten, kleinster Hub {least_swing}; der Nachlauf muss mindestens 0 sein, der Hub in (0, 1) liegen</translation>
    </message>
    <message>
        <source>loops: the input makes no whole cycle from one turning point to the next one of the same kind; record another cycle</source>
        <translation>Schleifen: Der Eingang durchläuft keinen ganzen Zyklus von einem Wendepunkt zum nächsten gleicher Art; zeichnen Sie einen weiteren Zyklus auf</translation>
    </message>
    <message>
        <source>amplitude dependence: {count} loops whose amplitudes differ by less than a factor of {least_spread}; record growing or decaying cycles</source>
        <translation>Amplitudenabhängigkeit: {count} Schleifen, deren Amplituden sich um weniger als den Faktor {least_spread} unterscheiden; wachsende oder abklingende Zyklen aufzeichnen</translation>
    </message>
    <message>
        <source>amplitude dependence: a loop has no width; there is nothing to fit</source>
        <translation>Amplitudenabhängigkeit: eine Schleife hat keine Breite; nichts anzupassen</translation>
    </message>
    <message>
        <source>{side}: shape {shape} for the columns {names}; give an (n, columns) array</source>
        <translation>{side}: Form {shape} für die Spalten {names}; ein Feld (n, Spalten) angeben</translation>
    </message>
    <message>
        <source>{side}: a value is not finite</source>
        <translation>{side}: ein Wert ist nicht endlich</translation>
    </message>
    <message>
        <source>signals: {inputs} samples of input, {outputs} of output; both numbers must be equal</source>
        <translation>Signale: {inputs} Abtastwerte des Eingangs, {outputs} des Ausgangs; beide Anzahlen müssen gleich sein</translation>
    </message>
    <message>
        <source>signals: rate {rate_hz} Hz; use a positive number</source>
        <translation>Signale: Rate {rate_hz} Hz; eine positive Zahl verwenden</translation>
    </message>
    <message>
        <source>signals: {inputs} inputs and {outputs} outputs; this method takes one of each, choose a pair</source>
        <translation>Signale: {inputs} Eingänge und {outputs} Ausgänge; dieses Verfahren nimmt je einen, ein Paar wählen</translation>
    </message>
    <message>
        <source>{side}: no channel chosen; name at least one</source>
        <translation>{side}: kein Kanal gewählt; mindestens einen angeben</translation>
    </message>
    <message>
        <source>{side}: the record has no {channel}; it has {names}</source>
        <translation>{side}: die Aufzeichnung hat kein {channel}; vorhanden: {names}</translation>
    </message>
    <message>
        <source>time: {count} row; a rate needs at least 2</source>
        <translation>Zeit: {count} Zeile; eine Rate braucht mindestens 2</translation>
    </message>
    <message>
        <source>time: row {worst} (t = {time_s} s) lies {off} s off the grid of {step_s} s, more than {jitter} % of a step; resample the record to a uniform rate first</source>
        <translation>Zeit: Zeile {worst} (t = {time_s} s) liegt {off} s neben dem Raster von {step_s} s, mehr als {jitter} % eines Schritts; die Aufzeichnung erst gleichmäßig neu abtasten</translation>
    </message>
    <message>
        <source>{name}: constant at {signal} over {count} samples; nothing can be identified, record a run in which it moves</source>
        <translation>{name}: konstant bei {signal} über {count} Abtastwerte; nichts lässt sich identifizieren, einen Lauf mit Bewegung aufzeichnen</translation>
    </message>
    <message>
        <source>resampling by {factor}: of {count} samples {left} remain after filtering, fewer than {shortest}; record longer or use a larger factor</source>
        <translation>Neuabtastung um {factor}: Von {count} Abtastwerten bleiben nach dem Filtern {left}, weniger als {shortest}; zeichnen Sie länger auf oder verwenden Sie einen größeren Faktor</translation>
    </message>
    <message>
        <source>resampling factor {factor}: not in (0, 1]; use one such as 0.15</source>
        <translation>Neuabtastungsfaktor {factor}: nicht in (0, 1]; etwa 0.15 verwenden</translation>
    </message>
    <message>
        <source>resampling factor {factor}: not a fraction with a denominator up to {finest}; use {fraction}</source>
        <translation>Neuabtastungsfaktor {factor}: kein Bruch mit einem Nenner bis {finest}; {fraction} verwenden</translation>
    </message>
    <message>
        <source>minimum step {least_step}: not in (0, 1]; use a value such as 0.01</source>
        <translation>kleinster Sprung {least_step}: nicht in (0, 1]; verwenden Sie einen Wert wie 0.01</translation>
    </message>
    <message>
        <source>steps: the record has no {axis}.{needed}; it has {names}</source>
        <translation>Sprünge: die Aufzeichnung hat kein {axis}.{needed}; vorhanden: {names}</translation>
    </message>
    <message>
        <source>steps: {axis}.{drive} holds no jump between two holds of at least {shortest_hold} rows and {shortest_hold_s} s; record a staircase</source>
        <translation>Sprünge: {axis}.{drive} enthält keinen Sprung zwischen zwei Ruhephasen von mindestens {shortest_hold} Zeilen und {shortest_hold_s} s; zeichnen Sie eine Treppe auf</translation>
    </message>
    <message>
        <source>microscope: {name} = {value}: must be more than 0</source>
        <translation>Mikroskop: {name} = {value}: muss größer als 0 sein</translation>
    </message>
    <message>
        <source>microscope: optical_axis = {axis}: must be a direction, for example [0.0, 0.0, 1.0] for a view from below</source>
        <translation>Mikroskop: optical_axis = {axis}: muss eine Richtung sein, etwa [0.0, 0.0, 1.0] für eine Ansicht von unten</translation>
    </message>
    <message>
        <source>microscope: skew {skew_rad} rad: must be within ±{pi}</source>
        <translation>Mikroskop: skew {skew_rad} rad: muss innerhalb von ±{pi} liegen</translation>
    </message>
    <message>
        <source>tool: approach_angle = {approach_rad} rad: must be more than 0 (flat on the dish) and at most {pi} (upright)</source>
        <translation>Werkzeug: approach_angle = {approach_rad} rad: muss größer als 0 (flach auf der Schale) und höchstens {pi} (aufrecht) sein</translation>
    </message>
    <message>
        <source>cell: radii {radii_m}, nucleus {nucleus_radius_m}, breaking {breaking_m}, dimple {dimple_m}, membrane {membrane_m} m: each must be more than 0</source>
        <translation>Zelle: Radien {radii_m}, Zellkern {nucleus_radius_m}, Durchbruch {breaking_m}, Delle {dimple_m}, Membran {membrane_m} m: jedes muss größer als 0 sein</translation>
    </message>
    <message>
        <source>plate.{key} = {value}: {bound}</source>
        <translation>plate.{key} = {value}: {bound}</translation>
    </message>
    <message>
        <source>divisions of the turn = {divisions}: must be {fewest} to {most}; {usual} is usual</source>
        <translation>Teilungen des Umfangs = {divisions}: müssen {fewest} bis {most} sein; üblich sind {usual}</translation>
    </message>
    <message>
        <source>no mesh can be made: the element at x {x} mm, y {y} mm has quality {quality} (at least {worst_quality}); edges of cut-outs are too close together or nearly in line there; align them, or move them apart</source>
        <translation>es lässt sich kein Netz bilden: das Element bei x {x} mm, y {y} mm hat die Güte {quality} (mindestens {worst_quality}); Kanten von Ausschnitten liegen dort zu nah beieinander oder fast in einer Linie; in eine Linie legen oder weiter auseinander</translation>
    </message>
    <message>
        <source>modes = {count}: must be 1 to {most}</source>
        <translation>Moden = {count}: müssen 1 bis {most} sein</translation>
    </message>
    <message>
        <source>must be at most {largest} m</source>
        <translation>darf höchstens {largest} m sein</translation>
    </message>
    <message>
        <source>must be at most 0.98 of rim_radius, which is {rim_radius} m</source>
        <translation>darf höchstens 0,98 von rim_radius sein, das sind {rim_radius} m</translation>
    </message>
    <message>
        <source>must be at least 0.02 of rim_radius, which is {rim_radius} m</source>
        <translation>muss mindestens 0,02 von rim_radius sein, das sind {rim_radius} m</translation>
    </message>
    <message>
        <source>must be {thinnest} to {thickest} m: a thin plate has {least_share} to {most_share} of its width from hub to rim</source>
        <translation>muss {thinnest} bis {thickest} m sein: eine dünne Platte hat {least_share} bis {most_share} ihrer Breite von Nabe zu Rand</translation>
    </message>
    <message>
        <source>must be within ± inertia {inertia}</source>
        <translation>muss innerhalb von ± inertia {inertia} liegen</translation>
    </message>
    <message>
        <source>must be at most the diameter of the hub</source>
        <translation>darf höchstens so groß wie der Durchmesser der Nabe sein</translation>
    </message>
    <message>
        <source>a {kind} needs it</source>
        <translation>die Art {kind} braucht es</translation>
    </message>
    <message>
        <source>a {kind} has none; remove it</source>
        <translation>die Art {kind} hat keines; entfernen</translation>
    </message>
    <message>
        <source>must be within ± 6.28 rad</source>
        <translation>muss innerhalb von ± 6,28 rad liegen</translation>
    </message>
    <message>
        <source>a hole has none</source>
        <translation>ein Loch hat keines</translation>
    </message>
    <message>
        <source>must be above inner_radius {inner}</source>
        <translation>muss über inner_radius {inner} liegen</translation>
    </message>
    <message>
        <source>the cut-out reaches from {inner} to {outer} m; it must stay between hub {hub_radius} and rim {rim_radius} m</source>
        <translation>der Ausschnitt reicht von {inner} bis {outer} m; er muss zwischen Nabe {hub_radius} und Rand {rim_radius} m bleiben</translation>
    </message>
    <message>
        <source>the cut-out with its surroundings reaches from {inner} to {outer} m; it must stay between hub {hub_radius} and rim {rim_radius} m</source>
        <translation>der Ausschnitt mit seiner Umgebung reicht von {inner} bis {outer} m; er muss zwischen Nabe {hub_radius} und Rand {rim_radius} m bleiben</translation>
    </message>
    <message>
        <source>{count} of them leave no material in between; make them smaller, or use fewer</source>
        <translation>{count} davon lassen kein Material dazwischen; machen Sie sie kleiner oder verwenden Sie weniger</translation>
    </message>
    <message>
        <source>its ring from {inner} to {outer} m overlaps another one, which ends at {one_outer} m; put the cut-outs into separate rings</source>
        <translation>ihr Ring von {inner} bis {outer} m überschneidet einen anderen, der bei {one_outer} m endet; legen Sie die Aussparungen in getrennte Ringe</translation>
    </message>
    <message>
        <source>{name}: the name must end with .vtu</source>
        <translation>{name}: der Name muss auf .vtu enden</translation>
    </message>
    <message>
        <source>the path of the pin&apos;s bottom must be rows of three finite numbers</source>
        <translation>der Weg des unteren Stiftendes muss aus Zeilen von drei endlichen Zahlen bestehen</translation>
    </message>
    <message>
        <source>duration of the ramp = {duration_s} s: must be positive</source>
        <translation>Dauer der Rampe = {duration_s} s: muss positiv sein</translation>
    </message>
    <message>
        <source>robot {name} has no axis {missing}; the plate carries {axes}: name a robot that has them</source>
        <translation>Roboter {name}: keine Achse {missing}; die Platte trägt {axes}: einen Roboter angeben, der sie hat</translation>
    </message>
    <message>
        <source>at the hub</source>
        <translation>an der Nabe</translation>
    </message>
    <message>
        <source>at the rim</source>
        <translation>am Rand</translation>
    </message>
    <message>
        <source>between hub and rim</source>
        <translation>zwischen Nabe und Rand</translation>
    </message>
    <message>
        <source>{where}, r {radius} mm, {degrees}°</source>
        <translation>{where}, r {radius} mm, {degrees}°</translation>
    </message>
    <message>
        <source>{name} stiffness</source>
        <translation>Steifigkeit {name}</translation>
    </message>
    <message>
        <source>the plate yields within the range of motion: {stress} MPa {place_text} at zn {zn} µm, thx {thx} µrad, thy {thy} µrad; its yield strength is {yield_stress} MPa: make it thinner or wider</source>
        <translation>die Platte fließt innerhalb des Bewegungsbereichs: {stress} MPa {place_text} bei zn {zn} µm, thx {thx} µrad, thy {thy} µrad; ihre Streckgrenze ist {yield_stress} MPa: dünner oder breiter machen</translation>
    </message>
    <message>
        <source>robot {robot}: axis.{axis} has no mass and stiffness that the plate could replace; give it mass, damping and stiffness</source>
        <translation>Roboter {robot}: axis.{axis} hat keine Masse und Steifigkeit, die die Platte ersetzen könnte; geben Sie Masse, Dämpfung und Steifigkeit an</translation>
    </message>
    <message>
        <source>the plate would make the robot invalid: {problem}</source>
        <translation>mit der Platte wäre der Roboter ungültig: {problem}</translation>
    </message>
    <message>
        <source>robot {name}: plate.pin.length: missing, and robot.pin_length too; give one</source>
        <translation>Roboter {name}: plate.pin.length: fehlt, und robot.pin_length auch; eines angeben</translation>
    </message>
    <message>
        <source>robot {name}: plate.pin.length = {length} m: must be {low} to {high} m, {shortest} to {longest} times its diameter, because it is computed as a beam</source>
        <translation>Roboter {name}: plate.pin.length = {length} m: muss {low} bis {high} m sein, das {shortest}- bis {longest}-Fache des Durchmessers; er wird als Balken berechnet</translation>
    </message>
    <message>
        <source>axis {axis}: speed {speed}: must be a finite number above 0, for an axis with a target</source>
        <translation>Achse {axis}: Geschwindigkeit {speed}: muss eine endliche Zahl über 0 sein, für eine Achse mit Ziel</translation>
    </message>
    <message>
        <source>axis {axis}: robot {name} has no such axis; use one of {axes}</source>
        <translation>Achse {axis}: Roboter {name} hat keine solche Achse; möglich: {axes}</translation>
    </message>
    <message>
        <source>axis {axis}: the target {position} is not a finite number</source>
        <translation>Achse {axis}: das Ziel {position} ist keine endliche Zahl</translation>
    </message>
    <message>
        <source>axis {axis}: target {position} is outside its range {low} to {high}; choose a target inside</source>
        <translation>Achse {axis}: Ziel {position} liegt außerhalb ihres Bereichs {low} bis {high}; ein Ziel innerhalb wählen</translation>
    </message>
    <message>
        <source>axis {axis}: target {position} needs {voltage} V, outside the amplifier&apos;s {low} V to {high} V; choose a target nearer to rest</source>
        <translation>Achse {axis}: Ziel {position} braucht {voltage} V, außerhalb der {low} V bis {high} V des Verstärkers; ein Ziel näher an der Ruhelage wählen</translation>
    </message>
    <message>
        <source>{name}: {axis}.cmd = {value} at row {row} is outside the range {low} to {high} of the model {model} by more than 5 % of the travel (bound {bound}). If this is a record of another machine, {remedy}; otherwise correct the unit in the record or the range in the robot file</source>
        <translation>{name}: {axis}.cmd = {value} in Zeile {row} liegt um mehr als 5 % des Verfahrwegs außerhalb des Bereichs {low} bis {high} des Modells {model} (Grenze {bound}). Falls dies die Aufzeichnung einer anderen Maschine ist: {remedy}; sonst die Einheit in der Aufzeichnung oder den Bereich in der Roboterdatei berichtigen</translation>
    </message>
    <message>
        <source>axis {axis}: {what} {value} at {row}t = {time} s is beyond the limit {bound}; {advice}</source>
        <translation>Achse {axis}: {what} {value} bei {row}t = {time} s liegt jenseits der Grenze {bound}; {advice}</translation>
    </message>
    <message>
        <source>row {row}, </source>
        <translation>Zeile {row}, </translation>
    </message>
    <message>
        <source>trajectory: it has no set-point column (axis.cmd); a trajectory needs at least one</source>
        <translation>Trajektorie: sie hat keine Sollwertspalte (axis.cmd); mindestens eine ist nötig</translation>
    </message>
    <message>
        <source>trajectory: robot {name} has no axis {axis}, only {axes}; rename the column or choose the robot it was made for</source>
        <translation>Trajektorie: Roboter {name} hat keine Achse {axis}, nur {axes}; die Spalte umbenennen oder den passenden Roboter wählen</translation>
    </message>
    <message>
        <source>trajectory: axis {name} is in units of {unit}, but the robot moves it in units of {expected}; correct the unit</source>
        <translation>Trajektorie: Achse {name} ist in Einheiten von {unit}, der Roboter bewegt sie aber in Einheiten von {expected}; die Einheit korrigieren</translation>
    </message>
    <message>
        <source>trajectory: axis {name} is moved by a force and has no controller in the robot file, so it cannot follow commands; add [axis.{key}.controller]</source>
        <translation>Trajektorie: Achse {name} wird von einer Kraft bewegt und hat in der Roboterdatei keinen Regler, kann also Sollwerten nicht folgen; [axis.{key}.controller] ergänzen</translation>
    </message>
    <message>
        <source>move or shrink the trajectory so that it stays inside the axis range</source>
        <translation>die Trajektorie verschieben oder verkleinern, sodass sie im Bereich der Achse bleibt</translation>
    </message>
    <message>
        <source>move or shrink the trajectory so that the amplifier can follow</source>
        <translation>die Trajektorie verschieben oder verkleinern, sodass der Verstärker folgen kann</translation>
    </message>
    <message>
        <source>{one}, and {other}</source>
        <translation>{one}, und {other}</translation>
    </message>
    <message>
        <source>stretch its time by a factor of {factor} or more, or smooth it there</source>
        <translation>ihre Zeit mindestens um den Faktor {factor} strecken oder sie dort glätten</translation>
    </message>
    <message>
        <source>rows are {interval} s apart there and the device holds each, then jumps: resample the trajectory at {rate} Hz (linear or cubic)</source>
        <translation>dort liegen die Zeilen {interval} s auseinander, das Gerät hält jede und springt dann: die Trajektorie mit {rate} Hz neu abtasten (linear oder kubisch)</translation>
    </message>
    <message>
        <source>trajectory: it cannot begin at {begin_s} s; choose a time from 0 to {time_s} s, before the last row</source>
        <translation>Trajektorie: Sie kann nicht bei {begin_s} s beginnen; eine Zeit von 0 bis {time_s} s wählen, vor der letzten Zeile</translation>
    </message>
    <message>
        <source>trajectory: repeated {times} times: must be 1 to {most_times}</source>
        <translation>Trajektorie: {times}-mal wiederholt: muss 1 bis {most_times} sein</translation>
    </message>
    <message>
        <source>trajectory: repeated {times} times, it has {count} rows (at most {most_rows}); repeat it less often</source>
        <translation>Trajektorie: {times}-mal wiederholt hat sie {count} Zeilen (höchstens {most_rows}); weniger oft wiederholen</translation>
    </message>
    <message>
        <source>trajectory: axis {axis} ends {apart} from where it begins, so it cannot be repeated; return to the start in its file</source>
        <translation>Trajektorie: Achse {axis} endet {apart} von ihrem Anfang entfernt: sie kann nicht wiederholt werden; in ihrer Datei zurückführen</translation>
    </message>
    <message>
        <source>the model cannot predict its motion: {fault}</source>
        <translation>das Modell kann die Bewegung nicht vorhersagen: {fault}</translation>
    </message>
    <message>
        <source>the speed</source>
        <translation>die Geschwindigkeit</translation>
    </message>
    <message>
        <source>the acceleration</source>
        <translation>die Beschleunigung</translation>
    </message>
    <message>
        <source>the range</source>
        <translation>der Bereich</translation>
    </message>
    <message>
        <source>the voltage</source>
        <translation>die Spannung</translation>
    </message>
    <message>
        <source>{quantity} of {axes}</source>
        <translation>{quantity} von {axes}</translation>
    </message>
    <message>
        <source>within the limits</source>
        <translation>innerhalb der Grenzen</translation>
    </message>
    <message>
        <source>inside {checked}; no limit is stated for {missing}</source>
        <translation>eingehalten: {checked}; ohne angegebene Grenze: {missing}</translation>
    </message>
    <message>
        <source>trajectory: it was checked for robot {name} with other axes or limits than those of {robot_name}; check it for this one</source>
        <translation>Trajektorie: geprüft für Roboter {name} mit anderen Achsen oder Grenzen als {robot_name}; für diesen prüfen</translation>
    </message>
    <message>
        <source>axis {axis}: a sweep from {start}: must begin between {low} and {high}, the training range of its inverse</source>
        <translation>Achse {axis}: ein Hub ab {start}: er muss zwischen {low} und {high} beginnen, dem Trainingsbereich ihrer Inversen</translation>
    </message>
    <message>
        <source>{name}: a travel of {way} on a spring of {spring_hz} Hz is more than the axes can accelerate; use at most {most}, or at most {other} Hz</source>
        <translation>{name}: ein Weg von {way} an einer Feder von {spring_hz} Hz ist mehr, als die Achsen beschleunigen können; höchstens {most} verwenden oder höchstens {other} Hz</translation>
    </message>
    <message>
        <source>{name}: {speed} within a time constant of {time_constant_s} s is more than the axes can accelerate; use at most {most}, or at least {other} s</source>
        <translation>{name}: {speed} innerhalb einer Zeitkonstante von {time_constant_s} s ist mehr, als die Achsen beschleunigen können; höchstens {most} verwenden oder mindestens {other} s</translation>
    </message>
    <message>
        <source>axis {axis}: the width {width} must be above 0 and at most {most}, a hundredth of the range</source>
        <translation>Achse {axis}: die Weite {width} muss über 0 und höchstens {most} sein, ein Hundertstel des Bereichs</translation>
    </message>
    <message>
        <source>axis {axis}: the one-sided approach to {target} begins at {begin}, outside {low} to {high}; stay {width} away from that end, or switch the approach off</source>
        <translation>Achse {axis}: die einseitige Anfahrt zu {target} beginnt bei {begin}, außerhalb von {low} bis {high}; {width} Abstand von diesem Ende halten oder die Anfahrt ausschalten</translation>
    </message>
    <message>
        <source>{error}; the one-sided approach begins there: choose the other side, or switch it off</source>
        <translation>{error}; dort beginnt die einseitige Anfahrt: die andere Seite nehmen oder sie ausschalten</translation>
    </message>
    <message>
        <source>the device has sent nothing yet; wait, or reconnect</source>
        <translation>das Gerät hat noch nichts gesendet; warten oder neu verbinden</translation>
    </message>
    <message>
        <source>the inverse of axis {axis} sets its voltage; remove the inverse</source>
        <translation>die Inverse von Achse {axis} stellt ihre Spannung; erst die Inverse abschalten</translation>
    </message>
    <message>
        <source>cells: the positions of the axes are unknown; home them, or reconnect</source>
        <translation>Zellen: die Positionen der Achsen sind unbekannt; referenzieren oder neu verbinden</translation>
    </message>
    <message>
        <source>cells: the list is full ({most} cells); remove one</source>
        <translation>Zellen: die Liste ist voll ({most} Zellen); entfernen Sie eine</translation>
    </message>
    <message>
        <source>axis {axis}: range {low} to {high}: the low end must be lower</source>
        <translation>Achse {axis}: ein Bereich von {low} bis {high}: das untere Ende muss kleiner sein</translation>
    </message>
    <message>
        <source>axis {axis}: target {target} is outside {low} to {high}, its narrowed range; choose a target inside, or widen the range in Control, Axes</source>
        <translation>Achse {axis}: Ziel {target} liegt außerhalb ihres eingeengten Bereichs {low} bis {high}; ein Ziel darin wählen oder den Bereich unter Steuerung, Achsen erweitern</translation>
    </message>
    <message>
        <source>z-stack: step {step}: must be above 0 µm</source>
        <translation>Z-Stapel: ein Schritt von {step}: muss über 0 µm sein</translation>
    </message>
    <message>
        <source>z-stack: {count} pictures: must be at most {most}; use a larger step</source>
        <translation>Z-Stapel: {count} Bilder: höchstens {most}; einen größeren Schritt nehmen</translation>
    </message>
    <message>
        <source>the return to the start position failed: {error}</source>
        <translation>Rückfahrt zur Startposition nicht möglich: {error}</translation>
    </message>
    <message>
        <source>z-stack: there is no picture; open a camera</source>
        <translation>Z-Stapel: es gibt kein Bild; eine Kamera öffnen</translation>
    </message>
    <message>
        <source>z-stack: {count} pictures of {each} MB: must be at most {most} MB together; use a larger step, or a part of the sensor</source>
        <translation>Z-Stapel: {count} Bilder zu {each} MB: zusammen höchstens {most} MB; einen größeren Schritt nehmen oder einen Teil des Sensors</translation>
    </message>
    <message>
        <source>{path}: its contents are not those of the record {name}; choose the file that was moved</source>
        <translation>{path}: der Inhalt ist nicht der der Aufzeichnung {name}; die verschobene Datei wählen</translation>
    </message>
    <message>
        <source>{path}: {rows} samples are too many for one record (at most {most}); export a section in the panel Recorder</source>
        <translation>{path}: {rows} Abtastwerte sind zu viele für eine Aufzeichnung (höchstens {most}); im Panel Rekorder einen Abschnitt exportieren</translation>
    </message>
    <message>
        <source>{path} cannot be deleted ({reason}); give this user permission to write there</source>
        <translation>{path}: die Datei lässt sich nicht löschen ({reason}); diesem Benutzer dort Schreibrecht geben</translation>
    </message>
    <message>
        <source>{path}: the library of records cannot be used ({reason}); free disk space, or give this user permission to write there. The records themselves are untouched</source>
        <translation>{path}: die Bibliothek der Aufzeichnungen ist nicht benutzbar ({reason}); Platz schaffen oder diesem Benutzer dort Schreibrecht geben. Die Aufzeichnungen selbst sind unberührt</translation>
    </message>
    <message>
        <source>{path}: the library of records has version {version}, but this program uses {own}: start the newer program, or move the file away; the records are then listed again, without their names and notes</source>
        <translation>{path}: die Bibliothek der Aufzeichnungen hat Version {version}, dieses Programm benutzt {own}: das neuere Programm starten oder die Datei verschieben; die Aufzeichnungen werden dann neu aufgelistet, ohne eingegebene Namen und Notizen</translation>
    </message>
    <message>
        <source>{path}: the library of records was damaged; it is kept as {aside}. The records are listed again from their files, without their names and notes</source>
        <translation>{path}: die Bibliothek der Aufzeichnungen war beschädigt; sie ist als {aside} aufbewahrt. Die Aufzeichnungen sind aus ihren Dateien neu aufgelistet, ohne eingegebene Namen und Notizen</translation>
    </message>
    <message>
        <source>preference {key} = {text}: {error}</source>
        <translation>Einstellung {key} = {text}: {error}</translation>
    </message>
    <message>
        <source>set-point {index}: differences {values}: 32 and 24 bits at most</source>
        <translation>Sollwert {index}: Differenzen {values}: höchstens 32 und 24 Bit</translation>
    </message>
    <message>
        <source>set-point: {count} bytes: must be {size} per axis</source>
        <translation>Sollwert: {count} Byte: müssen {size} je Achse sein</translation>
    </message>
    <message>
        <source>profile: {size} bytes: must be {quadratic_size} per segment</source>
        <translation>Profil: {size} Byte: müssen {quadratic_size} je Segment sein</translation>
    </message>
    <message>
        <source>profile, segments {values}: a number does not fit</source>
        <translation>Profil, Segmente {values}: eine Zahl passt nicht</translation>
    </message>
    <message>
        <source>{folder}: folder not found; create it, or name another one</source>
        <translation>{folder}: diesen Ordner gibt es nicht; anlegen oder einen anderen angeben</translation>
    </message>
    <message>
        <source>{place} already exists and is not overwritten; choose another name or folder</source>
        <translation>{place}: gibt es schon und wird nicht überschrieben; einen anderen Namen oder Ordner wählen</translation>
    </message>
    <message>
        <source>{name} cannot be the name of a plugin: it must have small letters, digits and single underscores, a letter first, at most {longest} characters, such as &apos;glass_stage&apos;</source>
        <translation>{name} kann kein Plugin heißen: erlaubt sind Kleinbuchstaben, Ziffern und einzelne Unterstriche, zuerst ein Buchstabe, höchstens {longest} Zeichen, etwa &apos;glass_stage&apos;</translation>
    </message>
    <message>
        <source>the {kind} {name} already exists{package}; choose another name</source>
        <translation>{kind} {name} gibt es schon{package}; einen anderen Namen wählen</translation>
    </message>
    <message>
        <source>{place} cannot be written ({reason}); choose another folder, or free disk space</source>
        <translation>{place}: kann nicht geschrieben werden ({reason}); einen anderen Ordner wählen oder Platz schaffen</translation>
    </message>
    <message>
        <source>{filename}: this file of the 3-D view cannot be read: {strerror}; install RoTeMiNa again</source>
        <translation>{filename}: diese Datei der 3D-Ansicht kann nicht gelesen werden: {strerror}; RoTeMiNa neu installieren</translation>
    </message>
    <message>
        <source>reading before</source>
        <translation>Messwert vorher</translation>
    </message>
    <message>
        <source>after</source>
        <translation>nachher</translation>
    </message>
    <message>
        <source>position reached</source>
        <translation>erreichte Position</translation>
    </message>
    <message>
        <source>axis {axis}: {runs} runs from {low} to {high}</source>
        <translation>Achse {axis}: {runs} Durchläufe von {low} bis {high}</translation>
    </message>
    <message>
        <source>error in the validation runs, rms: {before} before, {after} after</source>
        <translation>Fehler in den Prüfdurchläufen, Effektivwert: {before} vorher, {after} nachher</translation>
    </message>
    <message>
        <source>note: {note}</source>
        <translation>Hinweis: {note}</translation>
    </message>
    <message>
        <source>refused: {reason}</source>
        <translation>abgelehnt: {reason}</translation>
    </message>
    <message>
        <source>signal</source>
        <translation>Signal</translation>
    </message>
    <message>
        <source>rms</source>
        <translation>Effektivwert</translation>
    </message>
    <message>
        <source>peak</source>
        <translation>Spitze</translation>
    </message>
    <message>
        <source>of range</source>
        <translation>vom Bereich</translation>
    </message>
    <message>
        <source>rel. error</source>
        <translation>rel. Fehler</translation>
    </message>
    <message>
        <source>noise floor</source>
        <translation>Rauschgrenze</translation>
    </message>
    <message>
        <source>re-fitted</source>
        <translation>neu angepasst</translation>
    </message>
    <message>
        <source>tip path: the joints of a tip were not all measured in both runs</source>
        <translation>Bahn der Spitze: nicht alle Gelenke einer Spitze wurden in beiden Läufen gemessen</translation>
    </message>
    <message>
        <source>tip path: {rms} rms, {peak} peak apart</source>
        <translation>Bahn der Spitze: Abstand {rms} rms, {peak} maximal</translation>
    </message>
    <message>
        <source>there is no previous position</source>
        <translation>es gibt keine frühere Position</translation>
    </message>
    <message>
        <source>setting {name}: {text} is not a number; enter one with a decimal point</source>
        <translation>Einstellung {name}: {text} ist keine Zahl; eine mit Dezimalkomma eingeben</translation>
    </message>
    <message>
        <source>setting {name}: {text} is not a switch; enter true or false</source>
        <translation>Einstellung {name}: {text} ist kein Schalter; true oder false eingeben</translation>
    </message>
    <message>
        <source>setting {name}: {text} is not an integer</source>
        <translation>Einstellung {name}: {text} ist keine ganze Zahl</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>angehalten</translation>
    </message>
    <message>
        <source>the camera shows {width} × {height} px from {left}, {top}, but the calibration is for {view_width} × {view_height} px from {view_left}, {view_top}; restore the region of the camera, or calibrate again</source>
        <translation>die Kamera zeigt {width} × {height} px ab {left}, {top}, kalibriert sind {view_width} × {view_height} px ab {view_left}, {view_top}; den Ausschnitt wiederherstellen oder neu kalibrieren</translation>
    </message>
    <message>
        <source>{path}: this calibration is for camera {camera} with objective {objective}, not for {other_camera} with {other_objective}; move the file away and calibrate again</source>
        <translation>{path}: diese Kalibrierung gilt für Kamera {camera} mit Objektiv {objective}, nicht für {other_camera} mit {other_objective}; die Datei verschieben und neu kalibrieren</translation>
    </message>
    <message>
        <source>the tip is {distance} px from its target, but at most {most} px are permitted after a move; the calibration is no longer valid: calibrate again</source>
        <translation>die Spitze ist {distance} px vom Ziel entfernt, nach einer Fahrt sind höchstens {most} px erlaubt; die Kalibrierung gilt nicht mehr: neu kalibrieren</translation>
    </message>
    <message>
        <source>the tip is moving to a target; wait, or stop it first</source>
        <translation>die Spitze ist unterwegs zu einem Ziel; warten oder erst anhalten</translation>
    </message>
    <message>
        <source>axis {axis} is not a stepper axis; only these have backlash</source>
        <translation>Achse {axis} ist keine Schrittmotorachse; nur diese haben Spiel</translation>
    </message>
    <message>
        <source>the inverse of axis {axes} is off: the axis receives its targets as commands</source>
        <translation>die Inverse der Achse {axes} ist abgeschaltet: die Achse erhält ihre Ziele als Sollwerte</translation>
    </message>
    <message>
        <source>driver {name} stores no parameters</source>
        <translation>Treiber {name} speichert keine Parameter</translation>
    </message>
    <message>
        <source>the machine or the bounds of the tip have changed; play again</source>
        <translation>die Maschine oder die Grenzen der Spitze haben sich geändert; noch einmal abspielen</translation>
    </message>
    <message>
        <source>driver {name} has no limit switches</source>
        <translation>Treiber {name} hat keine Endschalter</translation>
    </message>
    <message>
        <source>axis {axis} has no amplifier for a voltage</source>
        <translation>Achse {axis} hat keinen Verstärker für eine Spannung</translation>
    </message>
    <message>
        <source>{where}{name} is not a valid name of a position; use 1 to {longest} letters without blanks at the ends</source>
        <translation>{where}{name} ist kein gültiger Name einer Position; 1 bis {longest} Zeichen ohne Leerzeichen an den Enden verwenden</translation>
    </message>
    <message>
        <source>{other} controls axis {axis}; stop it, or take over first</source>
        <translation>{other} steuert Achse {axis}; erst anhalten oder übernehmen</translation>
    </message>
    <message>
        <source>{name}: axis {axis} of robot {this} is not a piezo in open loop, which the loop needs</source>
        <translation>{name}: Achse {axis} des Roboters {this} ist kein Piezo im offenen Kreis, den der Regelkreis braucht</translation>
    </message>
    <message>
        <source>axis {axis} has no loop to open</source>
        <translation>Achse {axis} hat keinen Regelkreis, der sich abschalten ließe</translation>
    </message>
    <message>
        <source>robot {name} has no tip for a floor to limit</source>
        <translation>Roboter {name} hat keine Spitze, für die ein Boden gelten könnte</translation>
    </message>
    <message>
        <source>tip: the clearance {clearance} m below the tip must be a finite number, 0 or more</source>
        <translation>Spitze: der Abstand {clearance} m unter der Spitze muss eine endliche Zahl sein, 0 oder mehr</translation>
    </message>
    <message>
        <source>tip: too fast this close to its floor; move more slowly</source>
        <translation>Spitze: so dicht über dem Boden zu schnell; langsamer fahren</translation>
    </message>
    <message>
        <source>the device failed ({fault}); reconnect, then check its position</source>
        <translation>das Gerät ist ausgefallen ({fault}); neu verbinden, dann seine Position prüfen</translation>
    </message>
    <message>
        <source>driver {name} cannot execute profiles</source>
        <translation>Treiber {name} kann keine Profile ausführen</translation>
    </message>
    <message>
        <source>{name}: axis {axis} of robot {this} is not a piezo in open loop</source>
        <translation>{name}: Achse {axis} des Roboters {this} ist kein Piezo im offenen Kreis</translation>
    </message>
    <message>
        <source>{name}: axis {axis} had another range; train the inverse again</source>
        <translation>{name}: Achse {axis} hatte einen anderen Bereich; neu trainieren</translation>
    </message>
    <message>
        <source>axis {axis} has no inverse to remove</source>
        <translation>Achse {axis} hat keine Inverse zum Abschalten</translation>
    </message>
    <message>
        <source>compensated trajectory: {error}; the commands for the desired path exceed a limit: make it slower, smoother, or smaller</source>
        <translation>kompensierte Trajektorie: {error}; die Sollwerte für die gewünschte Bahn überschreiten eine Grenze: langsamer, glatter oder kleiner fahren</translation>
    </message>
    <message>
        <source>{stop} is active; release it first</source>
        <translation>{stop} ist aktiv; erst freigeben</translation>
    </message>
    <message>
        <source>the input devices are released</source>
        <extracomment>Buttons of the on-screen pad. All other actions have their own buttons in the window. The pad has no dead-man button, because such a button would only block the pad. Problems with the user&apos;s files, which :meth:`start` reports. Calibrations of sensors; those in use correct the readings from the start. The on-screen pad and its keys, an input device like any other. Cells to be penetrated one after the other; used only by the thread that shows them.</extracomment>
        <translation>die Eingabegeräte werden losgelassen</translation>
    </message>
    <message>
        <source>the machine has moved in the meantime; try again</source>
        <translation>die Maschine hat sich inzwischen bewegt; erneut versuchen</translation>
    </message>
    <message>
        <source>driver {name} has no switchable tool</source>
        <translation>Treiber {name} hat kein Werkzeug, das sich schalten ließe</translation>
    </message>
    <message>
        <source>nothing is playing</source>
        <translation>es läuft nichts, was sich anhalten ließe</translation>
    </message>
    <message>
        <source>nothing is paused to {what}</source>
        <translation>nichts ist pausiert, was sich {what} ließe</translation>
    </message>
    <message>
        <source>axis {axis} is at {at}, outside {low} to {high}; move it inside first</source>
        <translation>Achse {axis} ist bei {at}, außerhalb von {low} bis {high}; sie erst hineinfahren</translation>
    </message>
    <message>
        <source>the tip cannot be moved: {locked}</source>
        <translation>die Spitze kann nicht bewegt werden: {locked}</translation>
    </message>
    <message>
        <source>axis {axis}: only {nano} can be moved back while the tip stays in place; move {axis} back manually, or shorten the distance</source>
        <translation>Achse {axis}: nur {nano} kann zurückfahren, während die Spitze am Ort bleibt; {axis} von Hand zurückfahren oder den Weg kürzen</translation>
    </message>
    <message>
        <source>driver {driver} cannot execute profiles; a thrust needs that</source>
        <translation>Treiber {driver} kann keine Profile selbst ausführen; ein Einstich braucht das</translation>
    </message>
    <message>
        <source>axis {axis} of {robot} rotates; a penetration needs a linear axis</source>
        <translation>Achse {axis} von {robot} dreht; eine Penetration braucht eine lineare Achse</translation>
    </message>
    <message>
        <source>profile {name} needs {gone}, which is not connected; connected: {present}. Connect it, or choose or create another profile</source>
        <translation>Profil {name} braucht {gone}, nicht angeschlossen; angeschlossen: {present}. Anschließen oder ein anderes Profil wählen oder anlegen</translation>
    </message>
    <message>
        <source>not at rest yet: release it</source>
        <translation>noch nicht in Ruhe: loslassen</translation>
    </message>
    <message>
        <source>has not reported yet: move and release it</source>
        <translation>hat noch nichts gemeldet: bewegen und loslassen</translation>
    </message>
    <message>
        <source>has been at its end from the start: free it; if it rests there, calibrate it as one-sided</source>
        <translation>steht von Anfang an am Ende: lösen; ruht sie dort, als einseitig kalibrieren</translation>
    </message>
    <message>
        <source>reports {raw}, outside −1 to 1: disconnect and check it</source>
        <translation>meldet {raw}, außerhalb von −1 bis 1: abstecken und prüfen</translation>
    </message>
    <message>
        <source>axis {axis} reported nothing at rest; move it once, release it, and start again</source>
        <translation>Achse {axis} hat in Ruhe nichts gemeldet; einmal bewegen, loslassen, neu beginnen</translation>
    </message>
    <message>
        <source>axis {axis} hardly moved: {low} to {high} of −1 to 1, at least {least} is needed; move it to both ends</source>
        <translation>Achse {axis} kaum bewegt: {low} bis {high} von −1 bis 1, mindestens {least} nötig; an beide Enden bewegen</translation>
    </message>
    <message>
        <source>this is a replay; the machine does not move</source>
        <translation>dies ist eine Wiedergabe; nichts bewegt sich</translation>
    </message>
    <message>
        <source>{name}: the recording has failed ({reason}); the data so far are safe in {path}. Free disk space; the motion continues</source>
        <translation>{name}: die Aufnahme ist fehlgeschlagen ({reason}); die bisherigen Daten sind sicher in {path}. Speicherplatz schaffen; die Bewegung läuft weiter</translation>
    </message>
    <message>
        <source>{file}: the recording continues; {what}</source>
        <translation>{file}: die Aufnahme läuft weiter; {what}</translation>
    </message>
    <message>
        <source>{path}: {steps_s} ms of samples are missing during a move {at_s} s after the start, at most {rest_s} ms are permitted; choose a section before or after that</source>
        <translation>{path}: {at_s} s nach dem Beginn fehlen während einer Bewegung Messwerte für {steps_s} ms, höchstens {rest_s} ms sind erlaubt; einen Abschnitt davor oder danach wählen</translation>
    </message>
    <message>
        <source>{path}: the device was reconnected {at_s} s after the start, with a new clock; choose a section before or after that</source>
        <translation>{path}: das Gerät wurde {at_s} s nach dem Beginn neu verbunden, mit neuer Uhr; einen Abschnitt davor oder danach wählen</translation>
    </message>
    <message>
        <source>health card: the record gives no figure of {axis}: {names}</source>
        <translation>Zustandskarte: die Aufzeichnung liefert keinen Wert von {axis}: {names}</translation>
    </message>
    <message>
        <source>{name}:{line}: a carriage return is inside the line; end lines with LF or CRLF</source>
        <translation>{name}:{line}: in der Zeile steht ein Wagenrücklauf; Zeilen mit LF oder CRLF beenden</translation>
    </message>
    <message>
        <source>axis {axis}: a force moves this axis, so it holds no position; give it a cascade controller in the robot file</source>
        <translation>Achse {axis}: eine Kraft bewegt diese Achse, daher hält sie keine Position; ihr in der Roboterdatei einen Kaskadenregler geben</translation>
    </message>
    <message>
        <source>its sensor deviates by {much} from the expected position (at most {share} of the range)</source>
        <translation>ihr Sensor weicht um {much} von der erwarteten Position ab (höchstens {share} des Bereichs)</translation>
    </message>
    <message>
        <source>the model predicts an overshoot beyond the range of more than {margin} (1 % of the range): smooth or stretch the trajectory, or keep it away from the end of the range</source>
        <extracomment>Permitted predicted overshoot beyond the range, relative to the length of the range.</extracomment>
        <translation>das Modell sagt ein Überschwingen um mehr als {margin} (1 % des Bereichs) über den Bereich hinaus voraus: die Trajektorie glätten, strecken oder vom Ende des Bereichs fernhalten</translation>
    </message>
    <message>
        <source>inverse of axis {axis}: the command is {command}, but the inverse covers {low} to {high}: move the axis there first, or train with a wider record</source>
        <translation>Inverse von Achse {axis}: der Sollwert ist {command}, die Inverse reicht von {low} bis {high}: die Achse erst dorthin fahren oder mit einer größeren Bewegung trainieren</translation>
    </message>
    <message>
        <source>inverse of axis {axis}: row {row} of the trajectory needs a command outside {low} to {high}, the limits of the machine; stay farther from the ends of the range</source>
        <translation>Inverse von Achse {axis}: Zeile {row} der Trajektorie braucht einen Sollwert außerhalb von {low} bis {high}, den Grenzen der Maschine; von den Enden des Bereichs fernbleiben</translation>
    </message>
    <message>
        <source>axis {axis}: every sweep between {low} and {high} needs commands outside the limits of the machine; move the axis to mid-range first</source>
        <translation>Achse {axis}: jeder Durchlauf zwischen {low} und {high} braucht Sollwerte außerhalb der Grenzen der Maschine; die Achse erst in die Mitte fahren</translation>
    </message>
    <message>
        <source>the record has {rows} rows, {most} of them in motion; a comparison needs at least {least_moving}. Play the motion again</source>
        <translation>die Aufzeichnung hat {rows} Zeilen, davon {most} in Bewegung; ein Vergleich braucht mindestens {least_moving}. Die Bewegung noch einmal abspielen</translation>
    </message>
    <message>
        <source>{text} is not an amount; enter one such as 200urad, 5um or 30%</source>
        <translation>{text} ist keine Größe; eine wie 200urad, 5um oder 30% eingeben</translation>
    </message>
    <message>
        <source>distance from the low switch to zero</source>
        <translation>Weg vom unteren Schalter bis null</translation>
    </message>
    <message>
        <source>{url}: there is no such port ({said}); check the name, and whether the adapter is plugged in</source>
        <translation>{url}: diesen Anschluss gibt es nicht ({said}); den Namen prüfen und ob der Adapter angesteckt ist</translation>
    </message>
    <message>
        <source>{url}: the port has disappeared ({error}). Plug it in and reconnect, then check the position of the machine</source>
        <translation>{url}: der Anschluss ist verschwunden ({error}). Anstecken und neu verbinden, dann die Position der Maschine prüfen</translation>
    </message>
    <message>
        <source>{where} was reset and has lost its position; reconnect and home</source>
        <translation>{where} wurde zurückgesetzt und hat ihre Position verloren; neu verbinden und referenzieren</translation>
    </message>
    <message>
        <source>{where} has not answered for {quiet_s} s; check cable and supply, reconnect, then check the position of the machine</source>
        <translation>{where} antwortet seit {quiet_s} s nicht; Kabel und Versorgung prüfen, neu verbinden, dann die Position der Maschine prüfen</translation>
    </message>
    <message>
        <source>{name}: there is no simulated machine; connect the simulator</source>
        <translation>{name}: keine simulierte Maschine; den Simulator verbinden</translation>
    </message>
    <message>
        <source>{path}: not a picture; choose a TIFF or PNG file</source>
        <translation>{path}: kein Bild; eine TIFF- oder PNG-Datei wählen</translation>
    </message>
    <message>
        <source>{name}: axis {axis} is not a piezo in open loop, which {what} needs</source>
        <translation>{name}: Achse {axis} ist kein Piezo im offenen Kreis, wie ihn {what} braucht</translation>
    </message>
    <message>
        <source>inverse of axis {axis}: the axis is at {at}, but the inverse covers {low} to {high}: move the axis there first</source>
        <translation>Inverse von Achse {axis}: die Achse ist bei {at}, die Inverse reicht von {low} bis {high}: die Achse erst dorthin fahren</translation>
    </message>
    <message>
        <source>{where}, column {column}: {strip} is not a number</source>
        <translation>{where}, Spalte {column}: {strip} ist keine Zahl</translation>
    </message>
    <message>
        <source>{where}: no longer connected; plug it in again</source>
        <translation>{where}: nicht mehr angeschlossen; wieder anstecken</translation>
    </message>
    <message>
        <source>{reason}: release it first</source>
        <translation>{reason}: zuerst loslassen</translation>
    </message>
    <message>
        <source>Plots need no GPU; the 3-D view is slower. A graphics driver speeds it up.</source>
        <translation>Diagramme brauchen keine GPU; die 3-D-Ansicht ist langsamer. Ein Grafiktreiber beschleunigt sie.</translation>
    </message>
    <message>
        <source>the clock stands still</source>
        <translation>die Uhr steht still</translation>
    </message>
    <message>
        <source>Install again: pip install --upgrade rotemina (in its folder: pip install .).</source>
        <translation>Neu installieren: pip install --upgrade rotemina (in seinem Ordner: pip install .).</translation>
    </message>
    <message>
        <source>Without a display: QT_QPA_PLATFORM=offscreen. Otherwise see the Qt libraries above; with QT_DEBUG_PLUGINS=1 Qt names the missing plugin.</source>
        <translation>Ohne Anzeige: QT_QPA_PLATFORM=offscreen. Sonst siehe die Qt-Bibliotheken oben; mit QT_DEBUG_PLUGINS=1 nennt Qt das fehlende Plugin.</translation>
    </message>
    <message>
        <source>Commands work anyway. Start the window from a desktop.</source>
        <translation>Befehle funktionieren trotzdem. Das Fenster von einem Desktop aus starten.</translation>
    </message>
    <message>
        <source>See &apos;When a joystick is missing&apos; in docs/inputs.md.</source>
        <translation>Siehe „When a joystick is missing“ in docs/inputs.md.</translation>
    </message>
    <message>
        <source>Give the user permission to write there, or set HOME or XDG_*_HOME elsewhere.</source>
        <translation>Dem Benutzer dort Schreibrecht geben oder HOME bzw. XDG_*_HOME anders setzen.</translation>
    </message>
    <message>
        <source>{count} packages, versions as required</source>
        <translation>{count} Pakete, Versionen wie verlangt</translation>
    </message>
    <message>
        <source>it ended without a message</source>
        <translation>es endete ohne Meldung</translation>
    </message>
    <message>
        <source>none connected</source>
        <translation>keine angeschlossen</translation>
    </message>
    <message>
        <source>{free} GB free for {folder}</source>
        <translation>{free} GB frei für {folder}</translation>
    </message>
    <message>
        <source>Install Python &gt;= {version}.</source>
        <translation>Python &gt;= {version} installieren.</translation>
    </message>
    <message>
        <source>missing: {names}</source>
        <translation>es fehlen: {names}</translation>
    </message>
    <message>
        <source>all libraries of the platform {platform} found</source>
        <translation>alle Bibliotheken der Plattform {platform} gefunden</translation>
    </message>
    <message>
        <source>Qt does not start on {platform}: {reason}</source>
        <translation>Qt startet auf {platform} nicht: {reason}</translation>
    </message>
    <message>
        <source>{platform}: no display for a window</source>
        <translation>{platform}: keine Anzeige für ein Fenster</translation>
    </message>
    <message>
        <source>software rendering ({renderer})</source>
        <translation>Darstellung durch Software ({renderer})</translation>
    </message>
    <message>
        <source>no OpenGL</source>
        <translation>kein OpenGL</translation>
    </message>
    <message>
        <source>sudo usermod -aG {group} $USER, then log in again.</source>
        <translation>sudo usermod -aG {group} $USER, dann neu anmelden.</translation>
    </message>
    <message>
        <source>no permission for {names}</source>
        <translation>keine Berechtigung für {names}</translation>
    </message>
    <message>
        <source>Free at least {least} MB.</source>
        <translation>Mindestens {least} MB freigeben.</translation>
    </message>
    <message>
        <source>An hour at 1 kHz takes 0.8 GB; {ample} GB are ample.</source>
        <translation>Eine Stunde bei 1 kHz braucht 0,8 GB; {ample} GB reichen gut.</translation>
    </message>
    <message>
        <source>steps of {step}</source>
        <translation>Schritte von {step}</translation>
    </message>
    <message>
        <source>Times are wrong by more than {bound} ms: use Python &gt;= 3.13.</source>
        <translation>Zeiten sind um mehr als {bound} ms falsch: Python &gt;= 3.13 verwenden.</translation>
    </message>
    <message>
        <source>{name} {found}, {needed} needed</source>
        <translation>{name} {found}, nötig ist {needed}</translation>
    </message>
    <message>
        <source>no answer within {limit} s</source>
        <translation>keine Antwort innerhalb von {limit} s</translation>
    </message>
    <message>
        <source>en</source>
        <translation>de</translation>
    </message>
    <message>
        <source>Run report: {name}</source>
        <translation>Laufbericht: {name}</translation>
    </message>
    <message>
        <source>Gap</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>Signals</source>
        <translation>Signale</translation>
    </message>
    <message>
        <source>Penetrations</source>
        <translation>Penetrationen</translation>
    </message>
    <message>
        <source>Events</source>
        <translation>Ereignisse</translation>
    </message>
    <message>
        <source>Facts</source>
        <translation>Angaben</translation>
    </message>
    <message>
        <source>Note: {note}</source>
        <translation>Notiz: {note}</translation>
    </message>
    <message>
        <source>axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>gap, this run</source>
        <translation>Abweichung, dieser Lauf</translation>
    </message>
    <message>
        <source>without offset</source>
        <translation>ohne Versatz</translation>
    </message>
    <message>
        <source>nominal model</source>
        <translation>nominales Modell</translation>
    </message>
    <message>
        <source>noise floor of the sensor</source>
        <translation>Rauschgrenze des Sensors</translation>
    </message>
    <message>
        <source>Gap: rms of measured − model in use, offset included, while anything moves and 0.5 s after.</source>
        <translation>Abweichung: Effektivwert von gemessen − verwendetes Modell, mit Versatz, solange sich etwas bewegt und 0,5 s danach.</translation>
    </message>
    <message>
        <source>No axis moved.</source>
        <translation>Keine Achse hat sich bewegt.</translation>
    </message>
    <message>
        <source>Above: command, model in use and measured. Below: the gap; the band is the noise floor of the sensor.</source>
        <translation>Oben: Sollwert, verwendetes Modell und Messwert. Unten: die Abweichung; das Band ist die Rauschgrenze des Sensors.</translation>
    </message>
    <message>
        <source>began</source>
        <translation>Beginn</translation>
    </message>
    <message>
        <source>result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>reason</source>
        <translation>Grund</translation>
    </message>
    <message>
        <source>contact at</source>
        <translation>Kontakt bei</translation>
    </message>
    <message>
        <source>depth</source>
        <translation>Tiefe</translation>
    </message>
    <message>
        <source>peak speed</source>
        <translation>Spitzengeschwindigkeit</translation>
    </message>
    <message>
        <source>peak deviation</source>
        <translation>größte Abweichung</translation>
    </message>
    <message>
        <source>time [s]</source>
        <translation>Zeit [s]</translation>
    </message>
    <message>
        <source>event</source>
        <translation>Ereignis</translation>
    </message>
    <message>
        <source>text</source>
        <translation>Text</translation>
    </message>
    <message>
        <source>The first {shown} of {all} events.</source>
        <translation>Die ersten {shown} von {all} Ereignissen.</translation>
    </message>
    <message>
        <source>Nothing was noted.</source>
        <translation>Nichts wurde vermerkt.</translation>
    </message>
    <message>
        <source>Written by RoTeMiNa {version} from {file}.</source>
        <translation>Geschrieben von RoTeMiNa {version} aus {file}.</translation>
    </message>
    <message>
        <source>No axis has a gap: none moved.</source>
        <translation>Keine Achse hat eine Abweichung: keine hat sich bewegt.</translation>
    </message>
    <message>
        <source>The gaps refer to the model {model}; {told} was in use during the run.</source>
        <translation>Die Abweichungen beziehen sich auf das Modell {model}; während des Laufs war {told} in Gebrauch.</translation>
    </message>
    <message>
        <source>Largest gap: {axis}, {gap}</source>
        <translation>Größte Abweichung: {axis}, {gap}</translation>
    </message>
    <message>
        <source>Largest gap: {axis}, {gap} ({floors} × its noise floor)</source>
        <translation>Größte Abweichung: {axis}, {gap} ({floors} × Rauschgrenze)</translation>
    </message>
    <message>
        <source>The run was stopped early.</source>
        <translation>Der Lauf wurde vorzeitig angehalten.</translation>
    </message>
    <message>
        <source>date</source>
        <translation>Datum</translation>
    </message>
    <message>
        <source>duration</source>
        <translation>Dauer</translation>
    </message>
    <message>
        <source>robot</source>
        <translation>Roboter</translation>
    </message>
    <message>
        <source>driver</source>
        <translation>Treiber</translation>
    </message>
    <message>
        <source>model in use</source>
        <translation>verwendetes Modell</translation>
    </message>
    <message>
        <source>effects</source>
        <translation>Effekte</translation>
    </message>
    <message>
        <source>run</source>
        <translation>Lauf</translation>
    </message>
    <message>
        <source>operator</source>
        <translation>Bediener</translation>
    </message>
    <message>
        <source>sample</source>
        <translation>Probe</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>command</source>
        <translation>Sollwert</translation>
    </message>
    <message>
        <source>gap [{unit}]</source>
        <translation>Abweichung [{unit}]</translation>
    </message>
    <message>
        <source>Command, model in use and measured of {axis}, and the gap</source>
        <translation>Sollwert, verwendetes Modell und Messwert von {axis} sowie die Abweichung</translation>
    </message>
    <message>
        <source>axis {axis}: {parameter} {asked} → {used} (× {factor}), for {cause}</source>
        <translation>Achse {axis}: {parameter} {asked} → {used} (× {factor}), wegen: {cause}</translation>
    </message>
    <message>
        <source>{range} of the motion that the model predicts</source>
        <translation>{range} der Bewegung, die das Modell vorhersagt</translation>
    </message>
    <message>
        <source>the limits</source>
        <translation>die Grenzen</translation>
    </message>
    <message>
        <source>the speed limit {limit}</source>
        <translation>die Geschwindigkeitsgrenze {limit}</translation>
    </message>
    <message>
        <source>the acceleration limit {limit}</source>
        <translation>die Beschleunigungsgrenze {limit}</translation>
    </message>
    <message>
        <source>axis {axis}: {parameter} {asked} is beyond {used}, the {side} permitted by {cause}</source>
        <translation>Achse {axis}: {parameter} {asked} liegt jenseits der Grenze {used} ({side}), Ursache: {cause}</translation>
    </message>
    <message>
        <source>the range {low} to {high}</source>
        <translation>der Bereich {low} bis {high}</translation>
    </message>
    <message>
        <source>{limits} and the jerk</source>
        <translation>{limits} und der Ruck</translation>
    </message>
    <message>
        <source>silent: a streaming device has sent nothing for {limit} s and counts as released. Check its battery, radio link or cable; then release it and start again</source>
        <extracomment>Actions that last while their button is held. They are never reported as pressed. Latest reading; None if no reading is valid. Why the device cannot be used; None if it can. Why the device was lost in the last step; None if it was not. Actions pressed in the last step, and actions held.</extracomment>
        <translation>stumm: ein laufend sendendes Gerät hat seit {limit} s nichts gesendet und gilt als losgelassen. Batterie, Funkverbindung oder Kabel prüfen; dann loslassen und neu beginnen</translation>
    </message>
    <message>
        <source>silent for {limit} s while it moved something, so it counts as released: its link may have failed. Release it and start again, and move the stick a little at least every {limit} s; or choose under Set up, Mapping that it continues while silent</source>
        <translation>stumm seit {limit} s, während es etwas bewegte; es gilt daher als losgelassen: seine Verbindung kann ausgefallen sein. Loslassen und neu beginnen und den Joystick mindestens alle {limit} s ein wenig bewegen; oder unter Einrichten, Belegung „Wenn es schweigt: weiterfahren“ wählen</translation>
    </message>
    <message>
        <source>a frame for axis {number}, which the board does not have</source>
        <translation>ein Rahmen für Achse {number}, die die Karte nicht hat</translation>
    </message>
    <message>
        <source>axis {axis}: a command of {steps} steps is outside its range {low} to {high}</source>
        <translation>Achse {axis}: ein Sollwert von {steps} Schritten liegt außerhalb ihres Bereichs {low} bis {high}</translation>
    </message>
    <message>
        <source>axis {axis}: a command of {speed} steps/s is above its limit {limit}</source>
        <translation>Achse {axis}: ein Sollwert von {speed} Schritten/s liegt über ihrer Grenze {limit}</translation>
    </message>
    <message>
        <source>set-point {index}: its start position is unknown</source>
        <translation>Sollwert {index}: seine Startposition ist unbekannt</translation>
    </message>
    <message>
        <source>the controller is locked by an alarm; clear the fault, then home</source>
        <translation>die Steuerung ist durch einen Alarm gesperrt; den Fehler quittieren, dann Referenzfahrt</translation>
    </message>
    <message>
        <source>the controller only checks G-code and moves nothing ($C); clear the fault</source>
        <translation>die Steuerung prüft G-Code nur und bewegt nichts ($C); den Fehler quittieren</translation>
    </message>
    <message>
        <source>the controller sleeps and its motors have no current; clear the fault, then home</source>
        <translation>die Steuerung schläft, und ihre Motoren sind stromlos; den Fehler quittieren, dann Referenzfahrt</translation>
    </message>
    <message>
        <source>the controller waits for a tool change; clear the fault to end it</source>
        <translation>die Steuerung wartet auf einen Werkzeugwechsel; den Fehler quittieren, um ihn zu beenden</translation>
    </message>
    <message>
        <source>the controller is starting; clear the fault when it is ready</source>
        <translation>die Steuerung startet; den Fehler quittieren, wenn sie bereit ist</translation>
    </message>
    <message>
        <source>the safety door is open; close it, then clear the fault</source>
        <translation>die Schutztür ist offen; sie schließen, dann den Fehler quittieren</translation>
    </message>
    <message>
        <source>the safety door was opened and is closed again; clear the fault</source>
        <translation>die Schutztür wurde geöffnet und ist wieder geschlossen; den Fehler quittieren</translation>
    </message>
    <message>
        <source>the controller was paused (feed hold) by one of its buttons or by another program; clear the fault</source>
        <translation>die Steuerung wurde durch eine ihrer Tasten oder ein anderes Programm unterbrochen (Vorschubhalt); den Fehler quittieren</translation>
    </message>
    <message>
        <source>the controller reports a state that this program does not know, {state}; check the machine, then clear the fault</source>
        <translation>die Steuerung meldet einen Zustand, den dieses Programm nicht kennt, {state}; die Maschine prüfen, dann den Fehler quittieren</translation>
    </message>
    <message>
        <source>{modes} is missing</source>
        <translation>{modes} fehlt</translation>
    </message>
    <message>
        <source>this driver never sends such a line</source>
        <translation>eine solche Zeile sendet dieser Treiber nie</translation>
    </message>
    <message>
        <source>{word} is not a valid word</source>
        <translation>{word} ist kein gültiges Wort</translation>
    </message>
    <message>
        <source>unknown axis {letter}</source>
        <translation>unbekannte Achse {letter}</translation>
    </message>
    <message>
        <source>{letter} must be {low} to {high}</source>
        <translation>{letter} muss {low} bis {high} sein</translation>
    </message>
    <message>
        <source>gcode: {line} was not sent: {why}</source>
        <translation>gcode: {line} wurde nicht gesendet: {why}</translation>
    </message>
    <message>
        <source>nothing arrived; check the controller&apos;s power, its cable, and that this is its port</source>
        <translation>nichts kam an; prüfen: Versorgung und Kabel der Steuerung, und ob dies ihr Anschluss ist</translation>
    </message>
    <message>
        <source>{count} bytes arrived that are not text; the baud rate is wrong (GRBL: 115200), or there is interference on the line</source>
        <translation>{count} Byte kamen an, die kein Text sind; die Baudrate ist falsch (GRBL: 115200), oder die Leitung ist gestört</translation>
    </message>
    <message>
        <source>only an echo of the sent bytes arrived; turn off the echo of the adapter or modem, and check that a controller is connected to it</source>
        <translation>nur ein Echo der gesendeten Bytes kam an; schalten Sie das Echo des Adapters oder Modems ab, und prüfen Sie, ob eine Steuerung daran angeschlossen ist</translation>
    </message>
    <message>
        <source>a controller answers, but the line also echoes the sent bytes ({reply}); turn off the echo of the adapter or modem</source>
        <translation>eine Steuerung antwortet, aber die Leitung gibt auch die gesendeten Bytes zurück ({reply}); schalten Sie das Echo des Adapters oder Modems ab</translation>
    </message>
    <message>
        <source>text arrived that is not a report of GRBL 1.1, grblHAL or FluidNC ({reply}); check which device is connected, and the baud rate</source>
        <translation>der empfangene Text ist keine Meldung von GRBL 1.1, grblHAL oder FluidNC ({reply}); prüfen Sie, welches Gerät angeschlossen ist, und die Baudrate</translation>
    </message>
    <message>
        <source>a controller with GRBL 0.9 or older answered ({reply}); this driver needs GRBL 1.1, grblHAL or FluidNC: update its firmware</source>
        <translation>eine Steuerung mit GRBL 0.9 oder älter antwortete ({reply}); dieser Treiber braucht GRBL 1.1, grblHAL oder FluidNC: ihre Firmware aktualisieren</translation>
    </message>
    <message>
        <source>{begin} … {end} ({count} characters)</source>
        <translation>{begin} … {end} ({count} Zeichen)</translation>
    </message>
    <message>
        <source>{name}:{line}: the last line has no line end, but this program always writes one: the file was cut off here; copy it again, delete the line, or add a line break if the line is complete</source>
        <translation>{name}:{line}: Der letzten Zeile fehlt das Zeilenende, das dieses Programm immer schreibt: Die Datei wurde hier abgeschnitten; erneut kopieren, die Zeile löschen oder, falls sie vollständig ist, mit einem Zeilenumbruch abschließen</translation>
    </message>
    <message>
        <source>{name}:{line}: the last number {number} has fewer digits than all above it, and the line has no line end: the file was cut off here; copy it again, or delete the line</source>
        <translation>{name}:{line}: Die letzte Zahl {number} hat weniger Stellen als alle darüber, und der Zeile fehlt das Zeilenende: Die Datei wurde hier abgeschnitten; erneut kopieren oder die Zeile löschen</translation>
    </message>
    <message>
        <source>a compensation cannot be changed while the machine moves; stop it or wait</source>
        <translation>eine Kompensation lässt sich nicht ändern, während sich die Maschine bewegt; halten Sie sie an, oder warten Sie</translation>
    </message>
    <message>
        <source>board {address}: {count} requests are already waiting; try again later</source>
        <translation>Karte {address}: Es warten bereits {count} Anfragen; versuchen Sie es später erneut</translation>
    </message>
    <message>
        <source>profile of {count} ticks: a board can run {most} ticks at most; shorten the profile</source>
        <translation>Profil von {count} Takten: eine Karte kann höchstens {most} Takte ausführen; verkürzen Sie das Profil</translation>
    </message>
    <message>
        <source>{name}: {address}: choose a camera from the list</source>
        <translation>{name}: {address}: wählen Sie eine Kamera aus der Liste</translation>
    </message>
    <message>
        <source>it cannot search for cameras; see the log for the cause. Update or remove this plugin</source>
        <translation>es kann nicht nach Kameras suchen; die Ursache steht im Protokoll. Aktualisieren oder entfernen Sie dieses Plugin</translation>
    </message>
    <message>
        <source>{name}: there is no camera source {source}; installed: {known}</source>
        <translation>{name}: die Kameraquelle {source} gibt es nicht; installiert: {known}</translation>
    </message>
    <message>
        <source>there is no camera source {source}; available: {known}</source>
        <translation>die Kameraquelle {source} gibt es nicht; vorhanden: {known}</translation>
    </message>
    <message>
        <source>{name}: no picture could be read for {seconds} s; see the log for the cause. Check the camera and its cable, and open it again</source>
        <translation>{name}: Seit {seconds} s konnte kein Bild gelesen werden; die Ursache steht im Protokoll. Prüfen Sie Kamera und Kabel, und öffnen Sie sie erneut</translation>
    </message>
    <message>
        <source>axis {name} reads {at} during a move from {start} to {end} (controller coordinates); check the direction and the settings of this axis, then home</source>
        <translation>Achse {name} steht während einer Bewegung von {start} nach {end} bei {at} (Koordinaten der Steuerung); prüfen Sie Richtung und Einstellungen dieser Achse, dann Referenzfahrt</translation>
    </message>
    <message>
        <source>axis {name} is at {at} instead of {end} (controller coordinates)</source>
        <translation>Achse {name} steht bei {at} statt {end} (Koordinaten der Steuerung)</translation>
    </message>
    <message>
        <source>axis {axis}: the excitation would take more than {most_rows} rows at {rate} Hz; shorten it, move faster or lower the rate</source>
        <translation>Achse {axis}: die Anregung hätte mehr als {most_rows} Zeilen bei {rate} Hz; kürzen, schneller fahren oder die Rate senken</translation>
    </message>
    <message>
        <source>axis {names}: unstable with these effects: {named}. A motion grows by a factor of e every {fastest} s; change or remove one of them</source>
        <translation>Achse {names}: mit diesen Effekten instabil: {named}. Eine Bewegung wächst alle {fastest} s um den Faktor e; ändern oder entfernen Sie einen davon</translation>
    </message>
    <message>
        <source>{trouble}; no move was started</source>
        <translation>{trouble}; es wurde keine Bewegung gestartet</translation>
    </message>
    <message>
        <source>there is no picture; open a camera and wait for its first picture</source>
        <extracomment>Why the latest run was aborted; empty if it was not.</extracomment>
        <translation>kein Bild; eine Kamera öffnen und ihr erstes Bild abwarten</translation>
    </message>
    <message>
        <source>the 3-D view cannot listen on {host}: {strerror}; a firewall or the limit on open files may prevent it</source>
        <translation>die 3D-Ansicht kann an {host} nicht lauschen: {strerror}; vielleicht verhindert es eine Firewall oder die Grenze für offene Dateien</translation>
    </message>
    <message>
        <source>its report descriptor is truncated: the item at byte {at} of {count} needs {size} bytes of data</source>
        <translation>der Report-Deskriptor ist abgeschnitten: das Element bei Byte {at} von {count} braucht {size} Datenbytes</translation>
    </message>
</context>
</TS>
