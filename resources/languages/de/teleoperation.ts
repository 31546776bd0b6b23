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
        <source>Factor on way, speed and force of every coordinate</source>
        <translation>Faktor auf Weg, Geschwindigkeit und Kraft jeder Koordinate</translation>
    </message>
    <message>
        <source>Factor that acts now</source>
        <translation>Faktor, der jetzt wirkt</translation>
    </message>
    <message>
        <source>Step</source>
        <translation>Schritt</translation>
    </message>
    <message>
        <source>Moved by {source} of the stick</source>
        <translation>Bewegt durch {source} des Knüppels</translation>
    </message>
    <message>
        <source>{name} reference in {unit}</source>
        <translation>{name} Referenz in {unit}</translation>
    </message>
    <message>
        <source>Reference that the stick commands and the axes follow</source>
        <translation>Sollwert, den der Joystick vorgibt und dem die Achsen folgen</translation>
    </message>
    <message>
        <source>{name} deflection of the stick</source>
        <translation>{name} Auslenkung des Knüppels</translation>
    </message>
    <message>
        <source>Deflection of the stick, −100 % to 100 %; dashed: none is active</source>
        <translation>Auslenkung des Knüppels, −100 % bis 100 %; gestrichelt: keine verlässliche</translation>
    </message>
    <message>
        <source>{name} scaling</source>
        <translation>{name} Skalierung</translation>
    </message>
    <message>
        <source>Felt</source>
        <translation>Gefühlt</translation>
    </message>
    <message>
        <source>{name} felt contact force</source>
        <translation>{name} gefühlte Kontaktkraft</translation>
    </message>
    <message>
        <source>How hard a contact pushes back, −100 % to 100 % of the stick&apos;s force</source>
        <translation>Wie stark ein Kontakt zurückdrückt, −100 % bis 100 % der Kraft des Knüppels</translation>
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
        <source>Shown as soon as the axes&apos; positions are known and a device is there.</source>
        <translation>Erscheinen, sobald die Achspositionen bekannt sind und ein Gerät da ist.</translation>
    </message>
    <message>
        <source>Scales</source>
        <translation>Skalen</translation>
    </message>
    <message>
        <source>Coordinate whose scale is shown</source>
        <translation>Koordinate, deren Skala gezeigt wird</translation>
    </message>
    <message>
        <source>Coordinate whose scale is shown below</source>
        <translation>Koordinate, deren Skala unten gezeigt wird</translation>
    </message>
    <message>
        <source>Presets</source>
        <translation>Vorgaben</translation>
    </message>
    <message>
        <source>the axes&apos; positions are not known yet</source>
        <translation>die Achspositionen sind noch nicht bekannt</translation>
    </message>
    <message>
        <source>they are the presets</source>
        <translation>es sind die Vorgaben</translation>
    </message>
    <message>
        <source>Reset all scales of this mode to their presets</source>
        <translation>Alle Skalen dieses Modus auf die Vorgaben zurücksetzen</translation>
    </message>
    <message>
        <source>{title} of {name} {unit}</source>
        <translation>{title} von {name} {unit}</translation>
    </message>
    <message>
        <source>How teleoperation stands</source>
        <translation>Stand der Teleoperation</translation>
    </message>
    <message>
        <source>Device that drives</source>
        <translation>Gerät, das steuert</translation>
    </message>
    <message>
        <source>Whether the stick is active</source>
        <translation>Ob es verlässlich ist</translation>
    </message>
    <message>
        <source>Latest refusal or slowdown</source>
        <translation>Letzte Ablehnung oder Verlangsamung</translation>
    </message>
    <message>
        <source>Why nothing moves</source>
        <translation>Warum sich nichts bewegt</translation>
    </message>
    <message>
        <source>Last: {refused}</source>
        <translation>Zuletzt: {refused}</translation>
    </message>
    <message>
        <source>Press and drag: the cross moves x and y, the slider z; both spring back when released.</source>
        <translation>Drücken und ziehen: das Kreuz bewegt x und y, der Schieber z; losgelassen kehren beide zurück.</translation>
    </message>
    <message>
        <source>With the keyboard on it: arrows x and y, page up and down z, shift coarse, ctrl fine, space clutch.</source>
        <translation>Mit Tastatur: Pfeile x und y, Bild auf und ab z, Umschalt grob, Strg fein, Leertaste Kupplung.</translation>
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
Strg  × 0.1
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
        <source>Deflection at the ends of the pad, and of its keys</source>
        <translation>Auslenkung an den Enden des Felds und der Tasten</translation>
    </message>
    <message>
        <source>Take over</source>
        <translation>Übernehmen</translation>
    </message>
    <message>
        <source>the pad drives; the other device gets the drive back by being moved</source>
        <translation>das Feld steuert; das andere Gerät übernimmt wieder, sobald es bewegt wird</translation>
    </message>
    <message>
        <source>Let the pad drive, as long as the other device is left alone</source>
        <translation>Das Feld steuern lassen, solange das andere Gerät ruht</translation>
    </message>
    <message>
        <source>1 mm of stick = {way} of {what}</source>
        <translation>1 mm Knüppel = {way} {what}</translation>
    </message>
    <message>
        <source>full stick = {way}</source>
        <translation>voller Knüppel = {way}</translation>
    </message>
    <message>
        <source>full stick ends at {speed}, time constant {after}</source>
        <translation>voller Knüppel: {speed}, Zeitkonstante {after}</translation>
    </message>
    <message>
        <source>full stick ends {travel} away: {hz:.3g} Hz, damping ratio {damping:.3g}, time constant {after}</source>
        <translation>voller Knüppel: {travel} entfernt, {hz:.3g} Hz, Dämpfung {damping:.3g}, Zeitkonstante {after}</translation>
    </message>
    <message>
        <source>Piezo range</source>
        <translation>Piezobereich</translation>
    </message>
    <message>
        <source>Piezo range left in percent</source>
        <translation>Übriger Piezobereich in Prozent</translation>
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
        <source>By how much the mode has turned the tool since it began</source>
        <translation>Um wie viel der Modus das Werkzeug seit seinem Beginn gedreht hat</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>Übrig</translation>
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
        <source>to mid-range while the tables keep the tip where it is</source>
        <translation>in die Mitte bringen, während die Tische die Spitze am Ort halten</translation>
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
        <source>Way at full stick</source>
        <translation>Weg bei vollem Knüppel</translation>
    </message>
    <message>
        <source>Position; and impedance on a spring</source>
        <translation>Position; und Impedanz an einer Feder</translation>
    </message>
    <message>
        <source>Speed at full stick</source>
        <translation>Tempo bei vollem Knüppel</translation>
    </message>
    <message>
        <source>Rate; and impedance without a spring</source>
        <translation>Rate; und Impedanz ohne Feder</translation>
    </message>
    <message>
        <source>Time constant</source>
        <translation>Zeitkonstante</translation>
    </message>
    <message>
        <source>Impedance without a spring: in which the virtual mass gets to its speed</source>
        <translation>Impedanz ohne Feder: in der die virtuelle Masse ihre Geschwindigkeit erreicht</translation>
    </message>
    <message>
        <source>Spring frequency</source>
        <translation>Federfrequenz</translation>
    </message>
    <message>
        <source>Impedance: how fast the virtual mass swings; 0 is no spring, and it glides</source>
        <translation>Impedanz: wie schnell die virtuelle Masse schwingt; 0 ist keine Feder, sie gleitet</translation>
    </message>
    <message>
        <source>Damping ratio</source>
        <translation>Dämpfungsgrad</translation>
    </message>
    <message>
        <source>Impedance on a spring: below 1 it overshoots, above 1 it creeps</source>
        <translation>Impedanz an einer Feder: unter 1 schwingt sie über, über 1 kriecht sie</translation>
    </message>
    <message>
        <source>Contact gain</source>
        <translation>Kontaktverstärkung</translation>
    </message>
    <message>
        <source>Impedance: how much of the greatest safe force a contact pushes back; 0 is none</source>
        <translation>Impedanz: mit welchem Teil der größten sicheren Kraft ein Kontakt zurückdrückt; 0 ist keiner</translation>
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
        <source>{title}: {text!r} is no number; type one{unit} with a decimal point</source>
        <translation>{title}: {text!r} ist keine Zahl; eine{unit} mit Dezimalkomma eingeben</translation>
    </message>
    <message>
        <source>{typed}: must be {bound}</source>
        <translation>{typed}: erlaubt {bound}</translation>
    </message>
    <message>
        <source>{typed}: must be at most {most}, its range</source>
        <translation>{typed}: höchstens {most}, der Bereich</translation>
    </message>
    <message>
        <source>{typed}: must be at most {most}, its greatest speed</source>
        <translation>{typed}: höchstens {most}, die größte Geschwindigkeit</translation>
    </message>
    <message>
        <source>a finite number</source>
        <translation>eine endliche Zahl</translation>
    </message>
    <message>
        <source>bring the stick to the middle first</source>
        <translation>zuerst den Knüppel in die Mitte bringen</translation>
    </message>
    <message>
        <source>Micro</source>
        <translation>Mikro</translation>
    </message>
    <message>
        <source>The stick moves the tables: millimetres, in steps of 0.1 µm.</source>
        <translation>Der Knüppel bewegt die Tische: Millimeter, in Schritten von 0.1 µm.</translation>
    </message>
    <message>
        <source>Nano</source>
        <translation>Nano</translation>
    </message>
    <message>
        <source>The stick moves the piezos: two tilts, and micrometres along z.</source>
        <translation>Der Knüppel bewegt die Piezos: zwei Neigungen und Mikrometer entlang z.</translation>
    </message>
    <message>
        <source>Hybrid z</source>
        <translation>Hybrid z</translation>
    </message>
    <message>
        <source>The stick moves the tip: along z the piezo takes what fits and the table the rest.</source>
        <translation>Der Knüppel bewegt die Spitze: entlang z übernimmt der Piezo, was passt, der Tisch den Rest.</translation>
    </message>
    <message>
        <source>Fine x/y</source>
        <translation>Fein x/y</translation>
    </message>
    <message>
        <source>The stick moves the tip by piezos alone: x and y by tilting the tool, which costs its orientation.</source>
        <translation>Der Knüppel bewegt die Spitze nur mit Piezos: x und y durch Neigen des Werkzeugs, auf Kosten der Orientierung.</translation>
    </message>
    <message>
        <source>Pivot</source>
        <translation>Pivot</translation>
    </message>
    <message>
        <source>The stick tilts the tool while the tables hold its tip where it is.</source>
        <translation>Der Knüppel neigt das Werkzeug, während die Tische seine Spitze am Ort halten.</translation>
    </message>
    <message>
        <source>All axes</source>
        <translation>Alle Achsen</translation>
    </message>
    <message>
        <source>The stick moves the robot&apos;s first three axes.</source>
        <translation>Der Knüppel bewegt die ersten drei Achsen des Roboters.</translation>
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
        <source>The stick&apos;s position sets a speed; when released, the tip rests.</source>
        <translation>Die Stellung des Joysticks bestimmt eine Geschwindigkeit; losgelassen ruht die Spitze.</translation>
    </message>
    <message>
        <source>Impedance</source>
        <translation>Impedanz</translation>
    </message>
    <message>
        <source>The stick pushes a virtual mass, which glides or is on a spring; a contact pushes back.</source>
        <translation>Der Knüppel schiebt eine virtuelle Masse, gleitend oder an einer Feder; ein Kontakt drückt zurück.</translation>
    </message>
    <message>
        <source>The stick moves the axes of stage {mode!r}.</source>
        <translation>Der Knüppel bewegt die Achsen der Stufe {mode!r}.</translation>
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
        <source>No device drives</source>
        <translation>Kein Gerät steuert</translation>
    </message>
    <message>
        <source>Plug one in, or choose a profile for what is there.</source>
        <translation>Eines anstecken oder ein passendes Profil wählen.</translation>
    </message>
    <message>
        <source>Not active: {parts}</source>
        <translation>Nicht verlässlich: {parts}</translation>
    </message>
    <message>
        <source>Active</source>
        <translation>Aktiv</translation>
    </message>
    <message>
        <source>no answer</source>
        <translation>keine Antwort</translation>
    </message>
    <message>
        <source>driving</source>
        <translation>steuert</translation>
    </message>
    <message>
        <source>setting up</source>
        <translation>Einrichten</translation>
    </message>
    <message>
        <source>held</source>
        <translation>gehalten</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>wartet</translation>
    </message>
    <message>
        <source>ready</source>
        <translation>bereit</translation>
    </message>
    <message>
        <source>The loop of the input devices does not answer: stop the machine and restart the program.</source>
        <translation>Die Schleife der Eingabegeräte antwortet nicht: die Maschine anhalten und das Programm neu starten.</translation>
    </message>
    <message>
        <source>Release the stick to let the robot rest where it is.</source>
        <translation>Den Joystick loslassen, damit der Roboter bleibt, wo er ist.</translation>
    </message>
    <message>
        <source>Nothing moves: {reason}.</source>
        <translation>Nichts bewegt sich: {reason}.</translation>
    </message>
    <message>
        <source>Moves when the stick does.</source>
        <translation>Bewegt sich mit dem Knüppel.</translation>
    </message>
    <message>
        <source>the input devices are just being opened</source>
        <translation>die Eingabegeräte werden gerade geöffnet</translation>
    </message>
    <message>
        <source>input devices are being set up</source>
        <translation>Eingabegeräte werden eingerichtet</translation>
    </message>
    <message>
        <source>the profile has nothing for the pad</source>
        <translation>das Profil hat nichts für das Feld</translation>
    </message>
    <message>
        <source>{driver} drives; take over to use the pad</source>
        <translation>{driver} steuert; zum Benutzen des Felds übernehmen</translation>
    </message>
    <message>
        <source>now × {factor:g}</source>
        <translation>jetzt × {factor:g}</translation>
    </message>
    <message>
        <source>Clutch held: the stick moves, the robot does not.</source>
        <translation>Gekuppelt: der Knüppel bewegt sich, der Roboter nicht.</translation>
    </message>
    <message>
        <source>Hold the clutch (space on the pad) to bring the stick back without the robot.</source>
        <translation>Kupplung halten (Leertaste im Feld), um den Knüppel ohne den Roboter zurückzubringen.</translation>
    </message>
    <message>
        <source>Tip {name}</source>
        <translation>Spitze {name}</translation>
    </message>
    <message>
        <source>not shared in this mode</source>
        <translation>in diesem Modus nicht geteilt</translation>
    </message>
    <message>
        <source>{left} – re-centre</source>
        <translation>{left} – zentrieren</translation>
    </message>
    <message>
        <source>not by this mode</source>
        <translation>nicht in diesem Modus</translation>
    </message>
</context>
</TS>
