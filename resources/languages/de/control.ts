<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>control</name>
    <message>
        <source>{label} position</source>
        <translation>{label} Position</translation>
    </message>
    <message>
        <source>{label} state</source>
        <translation>{label} Zustand</translation>
    </message>
    <message>
        <source>{label} range left</source>
        <translation>{label} Restweg</translation>
    </message>
    <message>
        <source>Go</source>
        <translation>Los</translation>
    </message>
    <message>
        <source>Go to the typed {label}</source>
        <translation>Eingabe für {label} anfahren</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>unbekannt</translation>
    </message>
    <message>
        <source>{label} target in {symbol}</source>
        <translation>{label} Ziel in {symbol}</translation>
    </message>
    <message>
        <source>{way} left</source>
        <translation>noch {way}</translation>
    </message>
    <message>
        <source>{label}: the robot file gives no max_speed; use steps instead.</source>
        <translation>{label}: die Roboterdatei nennt keine max_speed; Schritte benutzen.</translation>
    </message>
    <message>
        <source>{label}: measured minus command</source>
        <translation>{label}: gemessen minus Sollwert</translation>
    </message>
    <message>
        <source>{label} does not move: its position is unknown.</source>
        <translation>{label} bewegt sich nicht: die Position ist unbekannt.</translation>
    </message>
    <message>
        <source>Measured minus command; the bound is {bound}.</source>
        <translation>Gemessen minus Sollwert; die Grenze ist {bound}.</translation>
    </message>
    <message>
        <source>Move?</source>
        <translation>Fahren?</translation>
    </message>
    <message>
        <source>one step</source>
        <translation>einen Schritt</translation>
    </message>
    <message>
        <source>Move {name} down {how}</source>
        <translation>{name} abwärts, {how}</translation>
    </message>
    <message>
        <source>Move {name} up {how}</source>
        <translation>{name} aufwärts, {how}</translation>
    </message>
    <message>
        <source>{low} to {high} {symbol}</source>
        <translation>{low} bis {high} {symbol}</translation>
    </message>
    <message>
        <source>Move {name} to the typed position</source>
        <translation>{name} zur eingegebenen Position fahren</translation>
    </message>
    <message>
        <source>its reading is too old</source>
        <translation>der Messwert ist zu alt</translation>
    </message>
    <message>
        <source>a trajectory is playing</source>
        <translation>eine Trajektorie wird abgespielt</translation>
    </message>
    <message>
        <source>Scaling</source>
        <translation>Skalierung</translation>
    </message>
    <message>
        <source>Meaning of the stick&apos;s position</source>
        <translation>Bedeutung der Auslenkung des Joysticks</translation>
    </message>
    <message>
        <source>Step preset</source>
        <translation>Stufe</translation>
    </message>
    <message>
        <source>Take over</source>
        <translation>Übernehmen</translation>
    </message>
    <message>
        <source>Mode {text}</source>
        <translation>Modus {text}</translation>
    </message>
    <message>
        <source>Device, mode and scaling</source>
        <translation>Gerät, Modus und Skalierung</translation>
    </message>
    <message>
        <source>Height of the tip</source>
        <translation>Höhe der Spitze</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Tempo</translation>
    </message>
    <message>
        <source>Micro stage</source>
        <translation>Mikrotisch</translation>
    </message>
    <message>
        <source>Nano stage</source>
        <translation>Nanotisch</translation>
    </message>
    <message>
        <source>Axes</source>
        <translation>Achsen</translation>
    </message>
    <message>
        <source>Hand</source>
        <translation>Hand</translation>
    </message>
    <message>
        <source>Positions</source>
        <translation>Positionen</translation>
    </message>
    <message>
        <source>Tip</source>
        <translation>Spitze</translation>
    </message>
    <message>
        <source>Penetration</source>
        <translation>Penetration</translation>
    </message>
    <message>
        <source>{name} stage</source>
        <translation>Stufe {name}</translation>
    </message>
    <message>
        <source>Axis {axis}; parameters: see the Penetration panel.</source>
        <translation>Achse {axis}; Parameter: siehe Panel Penetration.</translation>
    </message>
    <message>
        <source>motion is locked: {locked}</source>
        <translation>Bewegung ist gesperrt: {locked}</translation>
    </message>
    <message>
        <source>Saved positions</source>
        <translation>Gespeicherte Positionen</translation>
    </message>
    <message>
        <source>none saved yet</source>
        <translation>noch keine</translation>
    </message>
    <message>
        <source>Change pin or dish</source>
        <translation>Stift oder Schale wechseln</translation>
    </message>
    <message>
        <source>Skip</source>
        <translation>Überspringen</translation>
    </message>
    <message>
        <source>Teach here?</source>
        <translation>Hier setzen?</translation>
    </message>
    <message>
        <source>Retract</source>
        <translation>Zurückziehen</translation>
    </message>
    <message>
        <source>Go to the load position</source>
        <translation>Zur Ladeposition fahren</translation>
    </message>
    <message>
        <source>Go there</source>
        <translation>Anfahren</translation>
    </message>
    <message>
        <source>Discard the taught floor, and stop tracking the tip in the image</source>
        <translation>Gelernten Boden verwerfen; die Spitze im Bild nicht mehr verfolgen</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Stop and lock</source>
        <translation>Halt und sperren</translation>
    </message>
    <message>
        <source>Release</source>
        <translation>Freigeben</translation>
    </message>
    <message>
        <source>Find the tip in the microscope; lower the tip slowly with the manual controls</source>
        <translation>Die Spitze im Mikroskop suchen; mit der Handsteuerung langsam absenken</translation>
    </message>
    <message>
        <source>Show the microscope</source>
        <translation>Mikroskop zeigen</translation>
    </message>
    <message>
        <source>Teach the floor where the tip touches</source>
        <translation>Den Boden setzen, wo die Spitze aufsetzt</translation>
    </message>
    <message>
        <source>Teach floor</source>
        <translation>Boden setzen</translation>
    </message>
    <message>
        <source>name of this position</source>
        <translation>Name dieser Position</translation>
    </message>
    <message>
        <source>Name for the present position</source>
        <translation>Name für die jetzige Position</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Löschen</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>Home</source>
        <translation>Ruhe</translation>
    </message>
    <message>
        <source>Load</source>
        <translation>Laden</translation>
    </message>
    <message>
        <source>Work</source>
        <translation>Arbeit</translation>
    </message>
    <message>
        <source>Change …</source>
        <translation>Wechseln …</translation>
    </message>
    <message>
        <source>Home all</source>
        <translation>Referenzfahrt</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>no position is chosen</source>
        <translation>keine Position ist gewählt</translation>
    </message>
    <message>
        <source>Save the present target of all axes</source>
        <translation>Das jetzige Ziel aller Achsen speichern</translation>
    </message>
    <message>
        <source>this robot has no z axis to lift the tip with</source>
        <translation>dieser Roboter hat keine Achse z, mit der sich die Spitze heben lässt</translation>
    </message>
    <message>
        <source>Go to position {name!r} along a safe path; to change it, save another one under this name</source>
        <translation>Auf sicherer Bahn zur Position {name!r} fahren; zum Ändern eine andere unter diesem Namen speichern</translation>
    </message>
    <message>
        <source>Not set: press twice to save the present target of all axes</source>
        <translation>Nicht gesetzt: zweimal drücken, um das jetzige Ziel aller Achsen zu speichern</translation>
    </message>
    <message>
        <source>the position is not known</source>
        <translation>die Position ist unbekannt</translation>
    </message>
    <message>
        <source>type a name first</source>
        <translation>erst einen Namen eingeben</translation>
    </message>
    <message>
        <source>Change the pin or the dish, step by step</source>
        <translation>Stift oder Schale Schritt für Schritt wechseln</translation>
    </message>
    <message>
        <source>Find the limit switches of all axes</source>
        <translation>Die Endschalter aller Achsen suchen</translation>
    </message>
    <message>
        <source>Set here?</source>
        <translation>Hier setzen?</translation>
    </message>
    <message>
        <source>Replace?</source>
        <translation>Ersetzen?</translation>
    </message>
    <message>
        <source>Position {name!r} is saved.</source>
        <translation>Position {name!r} ist gespeichert.</translation>
    </message>
    <message>
        <source>Step</source>
        <translation>Schritt</translation>
    </message>
    <message>
        <source>Speed of moves</source>
        <translation>Geschwindigkeit der Bewegungen</translation>
    </message>
    <message>
        <source>angles</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>lengths</source>
        <translation>Längen</translation>
    </message>
    <message>
        <source>Jog step, {kind}</source>
        <translation>Tippschritt, {kind}</translation>
    </message>
    <message>
        <source>hold</source>
        <translation>halten</translation>
    </message>
    <message>
        <source>Height of the tip above its floor</source>
        <translation>Höhe der Spitze über ihrem Boden</translation>
    </message>
    <message>
        <source>0 to 2 mm above the floor; hatched: the slow zone</source>
        <translation>0 bis 2 mm über dem Boden; schraffiert: die langsame Zone</translation>
    </message>
    <message>
        <source>x, y, z [mm]: {place}</source>
        <translation>x, y, z [mm]: {place}</translation>
    </message>
    <message>
        <source>micro</source>
        <translation>Mikro</translation>
    </message>
    <message>
        <source>nano</source>
        <translation>Nano</translation>
    </message>
    <message>
        <source>hybrid</source>
        <translation>hybrid</translation>
    </message>
    <message>
        <source>fine</source>
        <translation>fein</translation>
    </message>
    <message>
        <source>pivot</source>
        <translation>Pivot</translation>
    </message>
    <message>
        <source>position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>rate</source>
        <translation>Rate</translation>
    </message>
    <message>
        <source>impedance</source>
        <translation>Impedanz</translation>
    </message>
    <message>
        <source>no data</source>
        <translation>keine Daten</translation>
    </message>
    <message>
        <source>{age:.1f} s old</source>
        <translation>vor {age:.1f} s</translation>
    </message>
    <message>
        <source>{age:.0f} min old</source>
        <translation>vor {age:.0f} min</translation>
    </message>
    <message>
        <source>{age:.0f} h old</source>
        <translation>vor {age:.0f} h</translation>
    </message>
    <message>
        <source>not homed</source>
        <translation>nicht referenziert</translation>
    </message>
    <message>
        <source>at most {height} from the middle of the workspace</source>
        <translation>höchstens {height} von der Mitte des Arbeitsraums</translation>
    </message>
    <message>
        <source>Only the axis ranges limit the tip. To teach a floor, use the Tip section of the Connection panel.</source>
        <translation>Nur die Achsbereiche begrenzen die Spitze. Ein Boden lässt sich im Fenster Verbindung, Abschnitt Spitze, setzen.</translation>
    </message>
    <message>
        <source> Within {height} of the floor, the tip descends at {speed} at most.</source>
        <translation> Bis {height} über dem Boden sinkt die Spitze mit höchstens {speed}.</translation>
    </message>
    <message>
        <source>{label} range: {low} … {high}</source>
        <translation>Bereich {label}: {low} … {high}</translation>
    </message>
    <message>
        <source>to {target}</source>
        <translation>nach {target}</translation>
    </message>
    <message>
        <source>{label}: {text!r} is not a position; type a number in {symbol} with a decimal point.</source>
        <translation>{label}: {text!r} ist keine Position; eine Zahl in {symbol} mit Dezimalkomma eingeben.</translation>
    </message>
    <message>
        <source>Tip: unknown.</source>
        <translation>Spitze: unbekannt.</translation>
    </message>
    <message>
        <source>Tip {height} below its floor.</source>
        <translation>Spitze {height} unter ihrem Boden.</translation>
    </message>
    <message>
        <source>; slow zone</source>
        <translation>; langsame Zone</translation>
    </message>
    <message>
        <source>Tip {height} above its floor{slow}.</source>
        <translation>Spitze {height} über ihrem Boden{slow}.</translation>
    </message>
    <message>
        <source>No floor taught</source>
        <translation>Kein Boden gesetzt</translation>
    </message>
    <message>
        <source>Tip unknown</source>
        <translation>Spitze unbekannt</translation>
    </message>
    <message>
        <source>floor at {height}</source>
        <translation>Boden bei {height}</translation>
    </message>
    <message>
        <source>objective at {height}</source>
        <translation>Objektiv bei {height}</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>Low end of the range</source>
        <translation>Unteres Ende des Bereichs</translation>
    </message>
    <message>
        <source>High end of the range</source>
        <translation>Oberes Ende des Bereichs</translation>
    </message>
    <message>
        <source>Narrow</source>
        <translation>Begrenzen</translation>
    </message>
    <message>
        <source>Whole</source>
        <translation>Ganz</translation>
    </message>
    <message>
        <source>Approach</source>
        <translation>Anfahrt</translation>
    </message>
    <message>
        <source>straight</source>
        <translation>direkt</translation>
    </message>
    <message>
        <source>from below</source>
        <translation>von unten</translation>
    </message>
    <message>
        <source>from above</source>
        <translation>von oben</translation>
    </message>
    <message>
        <source>Use</source>
        <translation>Übernehmen</translation>
    </message>
    <message>
        <source>the machine is moving</source>
        <translation>die Maschine bewegt sich</translation>
    </message>
    <message>
        <source>Measured backlash: {play}</source>
        <translation>Gemessenes Umkehrspiel: {play}</translation>
    </message>
    <message>
        <source>the model in use has no backlash of this axis; diagnose the axis first</source>
        <translation>das verwendete Modell enthält kein Umkehrspiel dieser Achse; erst die Achse diagnostizieren</translation>
    </message>
    <message>
        <source>Set the width to {factor} × the backlash of the model in use</source>
        <translation>Als Weite das {factor}-Fache des Umkehrspiels im verwendeten Modell setzen</translation>
    </message>
    <message>
        <source>Within {ends}</source>
        <translation>Innerhalb {ends}</translation>
    </message>
    <message>
        <source>Range</source>
        <translation>Bereich</translation>
    </message>
    <message>
        <source>Speed of jogging and go-to, relative to the axis&apos; maximum</source>
        <translation>Geschwindigkeit von Tippen und Anfahren, relativ zum Höchstwert der Achse</translation>
    </message>
    <message>
        <source>Distance of one press of + or − ({kind}); hold: while the button is pressed</source>
        <translation>Weg je Druck auf + oder − ({kind}); halten: solange der Knopf gedrückt ist</translation>
    </message>
    <message>
        <source>outdated</source>
        <translation>veraltet</translation>
    </message>
    <message>
        <source>Saved positions of all axes</source>
        <translation>Gespeicherte Positionen aller Achsen</translation>
    </message>
    <message>
        <source>Name for the present position; at most {most} characters</source>
        <translation>Name für die jetzige Position; höchstens {most} Zeichen</translation>
    </message>
    <message>
        <source>Raise the tip above both positions, move across, lower it</source>
        <translation>Die Spitze über beide Positionen heben, verfahren, absenken</translation>
    </message>
    <message>
        <source>Delete this position after confirmation</source>
        <translation>Diese Position nach einer Rückfrage löschen</translation>
    </message>
    <message>
        <source>Return to the position before the latest move: up, across, down</source>
        <translation>Zur Position vor der letzten Bewegung zurückfahren: hoch, quer, ab</translation>
    </message>
    <message>
        <source>Delete?</source>
        <translation>Löschen?</translation>
    </message>
    <message>
        <source>Prepare the penetration without motion</source>
        <translation>Die Penetration vorbereiten, ohne Bewegung</translation>
    </message>
    <message>
        <source>Start the armed penetration</source>
        <translation>Die vorbereitete Penetration starten</translation>
    </message>
    <message>
        <source>State of the joystick</source>
        <translation>Zustand des Joysticks</translation>
    </message>
    <message>
        <source>Axis whose range and approach are set</source>
        <translation>Achse, deren Bereich und Anfahrt gelten</translation>
    </message>
    <message>
        <source>Overshoot of the approach</source>
        <translation>Überfahrweg der Anfahrt</translation>
    </message>
    <message>
        <source>Side from which targets are approached</source>
        <translation>Seite, von der Ziele angefahren werden</translation>
    </message>
    <message>
        <source>Limit the targets of the axis to this range</source>
        <translation>Die Ziele der Achse auf diesen Bereich begrenzen</translation>
    </message>
    <message>
        <source>Restore the range of the robot file</source>
        <translation>Den Bereich der Roboterdatei wiederherstellen</translation>
    </message>
    <message>
        <source>only stepper axes have backlash</source>
        <translation>nur Schrittmotorachsen haben Spiel</translation>
    </message>
    <message>
        <source>Distance beyond the target, more than the backlash</source>
        <translation>Weg über das Ziel hinaus, mehr als das Spiel</translation>
    </message>
    <message>
        <source>its range is not limited</source>
        <translation>ihr Bereich ist nicht begrenzt</translation>
    </message>
    <message>
        <source>its position is unknown</source>
        <translation>die Position ist unbekannt</translation>
    </message>
    <message>
        <source>while pressed</source>
        <translation>solange gedrückt</translation>
    </message>
    <message>
        <source>A large move: press again to confirm</source>
        <translation>Eine große Bewegung: zur Bestätigung nochmals drücken</translation>
    </message>
    <message>
        <source>Target of {name}, {bounds}; press Enter or Go</source>
        <translation>Ziel von {name}, {bounds}; Enter oder Los</translation>
    </message>
    <message>
        <source>No tip: this robot has no kinematic chain to a tip.</source>
        <translation>Keine Spitze: dieser Roboter hat keine kinematische Kette zu einer Spitze.</translation>
    </message>
    <message>
        <source>Tip {height} above floor</source>
        <translation>Spitze {height} über Boden</translation>
    </message>
    <message>
        <source>Only the axis ranges limit this robot.</source>
        <translation>Nur die Achsbereiche begrenzen diesen Roboter.</translation>
    </message>
    <message>
        <source>{range}; remaining: {down} down, {up} up</source>
        <translation>{range}; übrig: {down} abwärts, {up} aufwärts</translation>
    </message>
    <message>
        <source>decimal point, no comma</source>
        <translation>nur ein Komma, keine Tausenderpunkte</translation>
    </message>
    <message>
        <source>not a number</source>
        <translation>keine Zahl</translation>
    </message>
    <message>
        <source>In brackets: the last approach was from the other side.</source>
        <translation>In Klammern: die letzte Anfahrt kam von der anderen Seite.</translation>
    </message>
    <message>
        <source>H⁻¹: commands pass through the inverse {name}, which you can remove in the Compensation panel.</source>
        <translation>H⁻¹: Sollwerte durchlaufen die Inverse {name}; sie lässt sich im Fenster Kompensation entfernen.</translation>
    </message>
    <message>
        <source>{sign}: jogs and go-to moves approach their target from below.</source>
        <translation>{sign}: Tippen und Anfahren nähern sich dem Ziel von unten.</translation>
    </message>
    <message>
        <source>{sign}: jogs and go-to moves approach their target from above.</source>
        <translation>{sign}: Tippen und Anfahren nähern sich dem Ziel von oben.</translation>
    </message>
    <message>
        <source>Tip at {height}; no floor is taught.</source>
        <translation>Spitze auf {height}; kein Boden ist gesetzt.</translation>
    </message>
    <message>
        <source>Skip this step</source>
        <translation>Diesen Schritt überspringen</translation>
    </message>
    <message>
        <source>position {name!r} is not saved; skip the step or save the position</source>
        <translation>Position {name!r} ist nicht gespeichert; den Schritt überspringen oder die Position speichern</translation>
    </message>
    <message>
        <source>Retract: move Z to its upper limit</source>
        <translation>Zurückziehen: Z an seine obere Grenze fahren</translation>
    </message>
    <message>
        <source>Stop and lock; then change the pin or the dish by hand</source>
        <translation>Stopp und sperren; dann Stift oder Schale von Hand wechseln</translation>
    </message>
    <message>
        <source>Pin or dish changed, hands clear: release the lock</source>
        <translation>Stift oder Schale gewechselt, Hände entfernt: Sperre lösen</translation>
    </message>
    <message>
        <source>Move above the work position with Z raised</source>
        <translation>Mit angehobenem Z über die Arbeitsposition fahren</translation>
    </message>
    <message>
        <source>Factor on distance, speed and force of the joystick</source>
        <translation>Faktor auf Weg, Geschwindigkeit und Kraft des Joysticks</translation>
    </message>
    <message>
        <source>Take over axes that another control moves; they continue until your first command</source>
        <translation>Achsen übernehmen, die eine andere Steuerung bewegt; sie fahren bis zum ersten eigenen Befehl weiter</translation>
    </message>
    <message>
        <source>no other control moves an axis</source>
        <translation>keine andere Steuerung bewegt eine Achse</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Control</source>
        <translation>Steuerung</translation>
    </message>
</context>
</TS>
