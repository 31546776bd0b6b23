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
        <source>go to [{symbol}]</source>
        <translation>→ [{symbol}]</translation>
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
        <source>Move?</source>
        <translation>Sicher?</translation>
    </message>
    <message>
        <source>while it is held</source>
        <translation>solange gehalten</translation>
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
        <source>Where {name} is to go, {bounds}; Enter, or Go</source>
        <translation>Wohin {name} fahren soll, {bounds}; Enter oder Los</translation>
    </message>
    <message>
        <source>A large move: press once more to make it</source>
        <translation>Eine große Bewegung: zum Ausführen nochmals drücken</translation>
    </message>
    <message>
        <source>Move {name} to the typed position</source>
        <translation>{name} zur eingegebenen Position fahren</translation>
    </message>
    <message>
        <source>its position is not known</source>
        <translation>die Position ist unbekannt</translation>
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
        <source>What the stick&apos;s place means</source>
        <translation>Was die Lage des Knüppels bedeutet</translation>
    </message>
    <message>
        <source>Step preset</source>
        <translation>Stufe</translation>
    </message>
    <message>
        <source>Factor on way, speed and force of the stick</source>
        <translation>Faktor auf Weg, Geschwindigkeit und Kraft des Knüppels</translation>
    </message>
    <message>
        <source>Take over</source>
        <translation>Übernehmen</translation>
    </message>
    <message>
        <source>No axis is driven now.</source>
        <translation>Keine Achse wird gefahren.</translation>
    </message>
    <message>
        <source>nobody else drives an axis that could be taken over</source>
        <translation>niemand sonst fährt eine Achse, die zu übernehmen wäre</translation>
    </message>
    <message>
        <source>Make the axes yours that somebody else drives; they go on until told otherwise</source>
        <translation>Achsen übernehmen, die ein anderer fährt; sie laufen weiter, bis anderes befohlen wird</translation>
    </message>
    <message>
        <source>Mode {text}</source>
        <translation>Modus {text}</translation>
    </message>
    <message>
        <source>How the joystick stands</source>
        <translation>Stand des Joysticks</translation>
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
        <source>Prepare the penetration; nothing moves yet</source>
        <translation>Die Penetration vorbereiten; noch bewegt sich nichts</translation>
    </message>
    <message>
        <source>Begin the armed penetration</source>
        <translation>Die scharfe Penetration beginnen</translation>
    </message>
    <message>
        <source>Phase of the penetration</source>
        <translation>Phase der Penetration</translation>
    </message>
    <message>
        <source>it is in {phase}; stop it first</source>
        <translation>sie läuft ({phase}); erst anhalten</translation>
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
        <source>Places of all axes, by name</source>
        <translation>Positionen aller Achsen, nach Namen</translation>
    </message>
    <message>
        <source>none saved yet</source>
        <translation>noch keine</translation>
    </message>
    <message>
        <source>name of this place</source>
        <translation>Name dieser Position</translation>
    </message>
    <message>
        <source>Name for where the robot is now</source>
        <translation>Name für die jetzige Position des Roboters</translation>
    </message>
    <message>
        <source>What to call where the robot is now; at most {most} letters</source>
        <translation>Wie die jetzige Position heißen soll; höchstens {most} Zeichen</translation>
    </message>
    <message>
        <source>Go there</source>
        <translation>Anfahren</translation>
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
        <source>Lift the tip above both places, go across, come down</source>
        <translation>Die Spitze über beide Orte heben, verfahren, absenken</translation>
    </message>
    <message>
        <source>Forget this position; asks once more</source>
        <translation>Diese Position vergessen; fragt nochmals</translation>
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
        <source>Keep where all axes are told to be</source>
        <translation>Die Sollpositionen aller Achsen behalten</translation>
    </message>
    <message>
        <source>Find the limit switches of all axes</source>
        <translation>Die Endschalter aller Achsen suchen</translation>
    </message>
    <message>
        <source>Go back to where the axes rested before the latest move: up, across, down</source>
        <translation>Dorthin zurück, wo die Achsen vor der letzten Bewegung ruhten: hoch, quer, ab</translation>
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
        <source>Sure?</source>
        <translation>Sicher?</translation>
    </message>
    <message>
        <source>old</source>
        <translation>alt</translation>
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
        <source>Speed of steps, hold and go-to, of the axis&apos; greatest</source>
        <translation>Tempo von Schritt, Halten und Anfahren, in Teilen des größten der Achse</translation>
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
        <source>How far one press of + or − moves an axis ({kind}); hold: while the button is held</source>
        <translation>Weg einer Achse je Druck auf + oder − ({kind}); halten: solange der Knopf gehalten wird</translation>
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
        <translation>{age:.1f} s alt</translation>
    </message>
    <message>
        <source>{age:.0f} min old</source>
        <translation>{age:.0f} min alt</translation>
    </message>
    <message>
        <source>{age:.0f} h old</source>
        <translation>{age:.0f} h alt</translation>
    </message>
    <message>
        <source>not homed</source>
        <translation>nicht referenziert</translation>
    </message>
    <message>
        <source>{label} range: {low} … {high}</source>
        <translation>Bereich {label}: {low} … {high}</translation>
    </message>
    <message>
        <source>{range}; left: {down} down, {up} up</source>
        <translation>{range}; noch: {down} abwärts, {up} aufwärts</translation>
    </message>
    <message>
        <source>a point, no comma</source>
        <translation>Punkt, kein Komma</translation>
    </message>
    <message>
        <source>no number</source>
        <translation>keine Zahl</translation>
    </message>
    <message>
        <source>to {target}</source>
        <translation>nach {target}</translation>
    </message>
    <message>
        <source>{label}: {text!r} is not a position; type a number in {symbol} with a decimal point.</source>
        <translation>{label}: {text!r} ist keine Position; eine Zahl in {symbol} mit Dezimalpunkt eingeben.</translation>
    </message>
    <message>
        <source>No tip: this robot has no chain of axes to one.</source>
        <translation>Keine Spitze: bei diesem Roboter führt keine Achskette dorthin.</translation>
    </message>
    <message>
        <source>Tip: unknown.</source>
        <translation>Spitze: unbekannt.</translation>
    </message>
    <message>
        <source>Tip {height} high; no floor is taught.</source>
        <translation>Spitze auf {height}; kein Boden ist gelernt.</translation>
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
        <source>Tip over floor {height}</source>
        <translation>Spitze über Boden {height}</translation>
    </message>
    <message>
        <source>No floor taught</source>
        <translation>Kein Boden gelernt</translation>
    </message>
    <message>
        <source>Tip unknown</source>
        <translation>Spitze unbekannt</translation>
    </message>
    <message>
        <source>Only the ranges of the axes hold this robot.</source>
        <translation>Nur die Achsbereiche begrenzen diesen Roboter.</translation>
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
        <source>at most {height} from the middle</source>
        <translation>höchstens {height} von der Mitte</translation>
    </message>
    <message>
        <source>Nothing bounds the tip but its axes. Teach a floor in Connection, Tip.</source>
        <translation>Nur die Achsen begrenzen die Spitze. Boden lernen: Verbindung, Spitze.</translation>
    </message>
    <message>
        <source> Within {height} above the floor it goes down at {speed}/s at most.</source>
        <translation> Bis {height} über dem Boden sinkt sie mit höchstens {speed}/s.</translation>
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
