<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>panels</name>
    <message>
        <source>Teleoperation</source>
        <translation>Teleoperation</translation>
    </message>
</context>
<context>
    <name>teleoperation</name>
    <message>
        <source>Mode</source>
        <translation>Modus</translation>
    </message>
    <message>
        <source>Scaling</source>
        <translation>Skalierung</translation>
    </message>
    <message>
        <source>Step preset</source>
        <translation>Schrittvorgabe</translation>
    </message>
    <message>
        <source>Step</source>
        <translation>Schritt</translation>
    </message>
    <message>
        <source>Moved by {source} of the stick</source>
        <translation>Bewegt durch {source} des Joysticks</translation>
    </message>
    <message>
        <source>{name} reference in {unit}</source>
        <translation>{name} Sollwert in {unit}</translation>
    </message>
    <message>
        <source>Reference that the stick commands and the axes follow</source>
        <translation>Sollwert, den der Joystick vorgibt und dem die Achsen folgen</translation>
    </message>
    <message>
        <source>{name} deflection of the stick</source>
        <translation>{name} Auslenkung des Joysticks</translation>
    </message>
    <message>
        <source>Deflection of the stick, −100 % to 100 %; dashed: none is active</source>
        <translation>Auslenkung des Joysticks, −100 % bis 100 %; gestrichelt: keine wirksam</translation>
    </message>
    <message>
        <source>{name} scaling</source>
        <translation>{name} Skalierung</translation>
    </message>
    <message>
        <source>tip</source>
        <translation>Spitze</translation>
    </message>
    <message>
        <source>Coordinates</source>
        <translation>Koordinaten</translation>
    </message>
    <message>
        <source>Scales</source>
        <translation>Maßstäbe</translation>
    </message>
    <message>
        <source>Coordinate whose scale is shown</source>
        <translation>Koordinate, deren Maßstab gezeigt wird</translation>
    </message>
    <message>
        <source>Coordinate whose scale is shown below</source>
        <translation>Koordinate, deren Maßstab unten gezeigt wird</translation>
    </message>
    <message>
        <source>Presets</source>
        <translation>Vorgaben</translation>
    </message>
    <message>
        <source>Reset all scales of this mode to their presets</source>
        <translation>Alle Maßstäbe dieses Modus auf die Vorgaben zurücksetzen</translation>
    </message>
    <message>
        <source>{title} of {name} {unit}</source>
        <translation>{title} von {name} {unit}</translation>
    </message>
    <message>
        <source>Whether the stick is active</source>
        <translation>Ob der Joystick wirksam ist</translation>
    </message>
    <message>
        <source>Latest refusal or slowdown</source>
        <translation>Letzte Ablehnung oder Verlangsamung</translation>
    </message>
    <message>
        <source>Last: {refused}</source>
        <translation>Zuletzt: {refused}</translation>
    </message>
    <message>
        <source>Press and drag: the cross moves x and y, the slider z; both spring back when released.</source>
        <extracomment>When its lease expires, the pad releases everything. Renewals are therefore much more frequent.</extracomment>
        <translation>Drücken und ziehen: das Kreuz bewegt x und y, der Schieber z; beim Loslassen kehren beide zurück.</translation>
    </message>
    <message>
        <source>Pad for x, y and z</source>
        <translation>Feld für x, y und z</translation>
    </message>
    <message>
        <source>Not now: {why_not}</source>
        <translation>Jetzt nicht: {why_not}</translation>
    </message>
    <message>
        <source>arrows  x y
page ↑ ↓  z
shift  × 10
ctrl  × 0.1
space  clutch</source>
        <translation>Pfeile  x y
Bild ↑ ↓  z
Umschalt  × 10
Strg  × 0,1
Leer  Kupplung</translation>
    </message>
    <message>
        <source>Pad</source>
        <translation>Feld</translation>
    </message>
    <message>
        <source>stick {percent:g} %</source>
        <translation>Hub {percent:g} %</translation>
    </message>
    <message>
        <source>Deflection of the pad in percent</source>
        <translation>Auslenkung des Felds in Prozent</translation>
    </message>
    <message>
        <source>Take over</source>
        <translation>Übernehmen</translation>
    </message>
    <message>
        <source>1 mm of stick = {way} of {what}</source>
        <translation>1 mm Joystick = {way} {what}</translation>
    </message>
    <message>
        <source>Piezo range</source>
        <translation>Piezobereich</translation>
    </message>
    <message>
        <source>100 %: the piezo is in the middle of its range; 0 %: at an end</source>
        <translation>100 %: der Piezo steht in der Mitte seines Bereichs; 0 %: an einem Ende</translation>
    </message>
    <message>
        <source>Tilt of the tool since the mode began</source>
        <translation>Neigung des Werkzeugs seit Beginn des Modus</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>Neigung</translation>
    </message>
    <message>
        <source>Re-centre {axis}</source>
        <translation>{axis} zentrieren</translation>
    </message>
    <message>
        <source>Re-centre all</source>
        <translation>Alle zentrieren</translation>
    </message>
    <message>
        <source>Bring zn {stays}</source>
        <translation>zn {stays}</translation>
    </message>
    <message>
        <source>Bring both tilts and zn {stays}; this takes longer</source>
        <translation>Beide Neigungen und zn {stays}; das dauert länger</translation>
    </message>
    <message>
        <source>the machine is still moving; release the stick first</source>
        <translation>die Maschine bewegt sich noch; erst den Joystick loslassen</translation>
    </message>
    <message>
        <source>above {bound}</source>
        <translation>über {bound}</translation>
    </message>
    <message>
        <source>at least {bound}</source>
        <translation>mindestens {bound}</translation>
    </message>
    <message>
        <source>below {bound}</source>
        <translation>unter {bound}</translation>
    </message>
    <message>
        <source>at most {bound}</source>
        <translation>höchstens {bound}</translation>
    </message>
    <message>
        <source>Speed at full stick</source>
        <translation>Tempo bei vollem Ausschlag</translation>
    </message>
    <message>
        <source>Time constant</source>
        <translation>Zeitkonstante</translation>
    </message>
    <message>
        <source>Spring frequency</source>
        <translation>Federfrequenz</translation>
    </message>
    <message>
        <source>Damping ratio</source>
        <translation>Dämpfungsgrad</translation>
    </message>
    <message>
        <source>Contact gain</source>
        <translation>Kontaktverstärkung</translation>
    </message>
    <message>
        <source>Impedance: gain of the contact force, in percent of the highest safe gain; 0: none</source>
        <translation>Impedanz: Verstärkung der Kontaktkraft, in Prozent der höchsten sicheren; 0: keine</translation>
    </message>
    <message>
        <source>above 0, up to {most}</source>
        <translation>über 0, bis {most}</translation>
    </message>
    <message>
        <source>{least} to {most}</source>
        <translation>{least} bis {most}</translation>
    </message>
    <message>
        <source>{title} of {name}</source>
        <translation>{title} von {name}</translation>
    </message>
    <message>
        <source>{typed}: must be {bound}</source>
        <translation>{typed}: erlaubt {bound}</translation>
    </message>
    <message>
        <source>a finite number</source>
        <translation>eine endliche Zahl</translation>
    </message>
    <message>
        <source>Micro</source>
        <translation>Mikro</translation>
    </message>
    <message>
        <source>Nano</source>
        <translation>Nano</translation>
    </message>
    <message>
        <source>Hybrid z</source>
        <translation>Hybrid z</translation>
    </message>
    <message>
        <source>Fine x/y</source>
        <translation>Fein x/y</translation>
    </message>
    <message>
        <source>Pivot</source>
        <translation>Pivot</translation>
    </message>
    <message>
        <source>All axes</source>
        <translation>Alle Achsen</translation>
    </message>
    <message>
        <source>The stick moves the robot&apos;s first three axes.</source>
        <translation>Der Joystick bewegt die ersten drei Achsen des Roboters.</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>Rate</source>
        <translation>Rate</translation>
    </message>
    <message>
        <source>The stick&apos;s position sets the tip&apos;s position; when released, the tip returns.</source>
        <translation>Die Stellung des Joysticks bestimmt die Position der Spitze; losgelassen kehrt sie zurück.</translation>
    </message>
    <message>
        <source>Impedance</source>
        <translation>Impedanz</translation>
    </message>
    <message>
        <source>The stick moves the axes of stage {mode!r}.</source>
        <translation>Der Joystick bewegt die Achsen der Stufe {mode!r}.</translation>
    </message>
    <message>
        <source>On-screen pad</source>
        <translation>Bildschirmfeld</translation>
    </message>
    <message>
        <source> and </source>
        <translation> und </translation>
    </message>
    <message>
        <source>Not active: {parts}</source>
        <translation>Nicht wirksam: {parts}</translation>
    </message>
    <message>
        <source>Active</source>
        <translation>Wirksam</translation>
    </message>
    <message>
        <source>no answer</source>
        <translation>keine Antwort</translation>
    </message>
    <message>
        <source>setting up</source>
        <translation>Einrichten</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>wartet</translation>
    </message>
    <message>
        <source>Hand control waits: {reason}.</source>
        <translation>Handsteuerung wartet: {reason}.</translation>
    </message>
    <message>
        <source>The robot follows the stick.</source>
        <translation>Der Roboter folgt dem Joystick.</translation>
    </message>
    <message>
        <source>input devices are being set up</source>
        <translation>Eingabegeräte werden eingerichtet</translation>
    </message>
    <message>
        <source>now × {factor:g}</source>
        <translation>jetzt × {factor:g}</translation>
    </message>
    <message>
        <source>Tip {name}</source>
        <translation>Spitze {name}</translation>
    </message>
    <message>
        <source>not available in this mode</source>
        <translation>in diesem Modus nicht verfügbar</translation>
    </message>
    <message>
        <source>{left} – re-centre</source>
        <translation>{left} – zentrieren</translation>
    </message>
    <message>
        <source>not in this mode</source>
        <translation>nicht in diesem Modus</translation>
    </message>
    <message>
        <source>Factor on distance, speed and force of every coordinate</source>
        <translation>Faktor auf Weg, Geschwindigkeit und Kraft jeder Koordinate</translation>
    </message>
    <message>
        <source>Present factor</source>
        <translation>Aktueller Faktor</translation>
    </message>
    <message>
        <source>to mid-range while the tables hold the tip in place</source>
        <translation>in die Mitte bringen, während die Tische die Spitze am Ort halten</translation>
    </message>
    <message>
        <source>Remaining piezo range in percent</source>
        <translation>Übriger Piezobereich in Prozent</translation>
    </message>
    <message>
        <source>Rotation of the tool since the mode began</source>
        <translation>Drehung des Werkzeugs seit Beginn des Modus</translation>
    </message>
    <message>
        <source>Remaining</source>
        <translation>Übrig</translation>
    </message>
    <message>
        <source>Distance at full stick</source>
        <translation>Weg bei vollem Ausschlag</translation>
    </message>
    <message>
        <source>Position, and impedance with a spring</source>
        <translation>Position sowie Impedanz mit Feder</translation>
    </message>
    <message>
        <source>Rate, and impedance without a spring</source>
        <translation>Rate sowie Impedanz ohne Feder</translation>
    </message>
    <message>
        <source>Impedance without a spring: time in which the virtual mass reaches its speed</source>
        <translation>Impedanz ohne Feder: Zeit, in der die virtuelle Masse ihre Geschwindigkeit erreicht</translation>
    </message>
    <message>
        <source>Impedance: frequency of the virtual mass; 0: no spring, the mass glides</source>
        <translation>Impedanz: Frequenz der virtuellen Masse; 0: keine Feder, die Masse gleitet</translation>
    </message>
    <message>
        <source>Impedance with a spring: overshoots below 1, creeps above 1</source>
        <translation>Impedanz mit Feder: unter 1 schwingt sie über, über 1 kriecht sie</translation>
    </message>
    <message>
        <source>{title}: {text!r} is not a number; enter one{unit} with a decimal point</source>
        <translation>{title}: {text!r} ist keine Zahl; eine{unit} mit Dezimalkomma eingeben</translation>
    </message>
    <message>
        <source>{typed}: must be at most the range of {most}</source>
        <translation>{typed}: höchstens der Bereich von {most}</translation>
    </message>
    <message>
        <source>{typed}: must be at most the maximum speed of {most}</source>
        <translation>{typed}: höchstens die Höchstgeschwindigkeit von {most}</translation>
    </message>
    <message>
        <source>Deflection at the ends of the pad and for its keys</source>
        <translation>Auslenkung an den Enden des Felds und für die Tasten</translation>
    </message>
    <message>
        <source>Control with the pad until the other device is moved</source>
        <translation>Mit dem Feld steuern, bis das andere Gerät bewegt wird</translation>
    </message>
    <message>
        <source>the pad is in control; moving the other device returns control to it</source>
        <translation>das Feld steuert; das andere Gerät übernimmt wieder, sobald es bewegt wird</translation>
    </message>
    <message>
        <source>State of teleoperation</source>
        <translation>Zustand der Teleoperation</translation>
    </message>
    <message>
        <source>Device in control</source>
        <translation>Steuerndes Gerät</translation>
    </message>
    <message>
        <source>Reason for no motion</source>
        <translation>Warum sich nichts bewegt</translation>
    </message>
    <message>
        <source>centre the stick first</source>
        <translation>zuerst den Joystick in die Mitte bringen</translation>
    </message>
    <message>
        <source>Press the clutch (space on the pad) to return the stick without the robot.</source>
        <translation>Kupplung drücken (Leertaste im Feld), um den Joystick ohne den Roboter zurückzubringen.</translation>
    </message>
    <message>
        <source>The stick moves the tables over millimetres in steps of 0.1 µm.</source>
        <translation>Der Joystick bewegt die Tische über Millimeter in Schritten von 0,1 µm.</translation>
    </message>
    <message>
        <source>The stick moves the piezos: two tilts and some micrometres along z.</source>
        <translation>Der Joystick bewegt die Piezos: zwei Neigungen und einige Mikrometer entlang z.</translation>
    </message>
    <message>
        <source>The stick moves the tip; along z the piezo moves within its range, the table does the rest.</source>
        <translation>Der Joystick bewegt die Spitze; entlang z fährt der Piezo in seinem Bereich, der Tisch den Rest.</translation>
    </message>
    <message>
        <source>The stick moves the tip only by piezos: x and y by tilting the tool.</source>
        <translation>Der Joystick bewegt die Spitze nur mit Piezos: x und y durch Neigen des Werkzeugs.</translation>
    </message>
    <message>
        <source>The stick tilts the tool while the tables hold its tip in place.</source>
        <translation>Der Joystick neigt das Werkzeug, während die Tische seine Spitze am Ort halten.</translation>
    </message>
    <message>
        <source>The stick&apos;s position sets a speed; when released, the tip stops.</source>
        <translation>Die Stellung des Joysticks bestimmt eine Geschwindigkeit; beim Loslassen hält die Spitze an.</translation>
    </message>
    <message>
        <source>The stick pushes a virtual mass with or without a spring; a contact pushes back.</source>
        <translation>Der Joystick schiebt eine virtuelle Masse mit oder ohne Feder; ein Kontakt drückt zurück.</translation>
    </message>
    <message>
        <source>No device in control</source>
        <translation>Kein Gerät steuert</translation>
    </message>
    <message>
        <source>input ready</source>
        <translation>Eingabe bereit</translation>
    </message>
    <message>
        <source>The input devices do not respond: stop the machine and restart the program.</source>
        <translation>Die Eingabegeräte antworten nicht: die Maschine anhalten und das Programm neu starten.</translation>
    </message>
    <message>
        <source>the input devices are being opened</source>
        <translation>die Eingabegeräte werden gerade geöffnet</translation>
    </message>
    <message>
        <source>the profile does not map the pad</source>
        <translation>das Profil belegt das Feld nicht</translation>
    </message>
    <message>
        <source>Clutch pressed: the stick moves without the robot.</source>
        <translation>Kupplung gedrückt: der Joystick bewegt sich ohne den Roboter.</translation>
    </message>
    <message>
        <source>Release the stick to stop the robot in place.</source>
        <translation>Den Joystick loslassen, um den Roboter anzuhalten.</translation>
    </message>
    <message>
        <source>Plug in a device, or choose a profile for a connected one.</source>
        <translation>Ein Gerät anstecken oder ein passendes Profil wählen.</translation>
    </message>
    <message>
        <source>in control</source>
        <translation>steuert</translation>
    </message>
    <message>
        <source>blocked</source>
        <translation>blockiert</translation>
    </message>
    <message>
        <source>{driver} is in control; take over to use the pad</source>
        <translation>{driver} steuert; übernehmen, um das Feld zu benutzen</translation>
    </message>
    <message>
        <source>the positions of the axes are unknown</source>
        <translation>die Achspositionen sind unbekannt</translation>
    </message>
    <message>
        <source>all scales have their presets</source>
        <translation>alle Maßstäbe haben ihre Vorgaben</translation>
    </message>
    <message>
        <source>Keyboard, when the pad has the focus: arrows x and y, page up and down z, shift coarse, ctrl fine, space clutch.</source>
        <translation>Tastatur, wenn das Feld den Fokus hat: Pfeile x und y, Bild auf und ab z, Umschalt grob, Strg fein, Leertaste Kupplung.</translation>
    </message>
    <message>
        <source>full deflection: {travel}, {hz:.3g} Hz, damping ratio {damping:.3g}, time constant {after}</source>
        <translation>voller Ausschlag: {travel}, {hz:.3g} Hz, Dämpfung {damping:.3g}, Zeitkonstante {after}</translation>
    </message>
    <message>
        <source>full deflection: {speed}, time constant {after}</source>
        <translation>voller Ausschlag: {speed}, Zeitkonstante {after}</translation>
    </message>
    <message>
        <source>full deflection = {way}</source>
        <translation>voller Ausschlag = {way}</translation>
    </message>
    <message>
        <source>Force</source>
        <translation>Kraft</translation>
    </message>
    <message>
        <source>Force of a contact at the stick, −100 % to 100 % of its maximum</source>
        <translation>Kraft eines Kontakts am Joystick, −100 % bis 100 % des Höchstwerts</translation>
    </message>
    <message>
        <source>Available when the positions of the axes are known and a device is connected.</source>
        <translation>Verfügbar, sobald die Achspositionen bekannt sind und ein Gerät angeschlossen ist.</translation>
    </message>
    <message>
        <source>{name} contact force at the stick</source>
        <translation>{name} Kontaktkraft am Joystick</translation>
    </message>
</context>
</TS>
