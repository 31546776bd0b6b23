<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>inputs</name>
    <message>
        <source>Axis {name}</source>
        <translation>Achse {name}</translation>
    </message>
    <message>
        <source>{name}: thin what the device says, thick the calibrated deflection, both −100 % to 100 %; shaded the dead zone</source>
        <translation>{name}: dünn der Rohwert des Geräts, dick die kalibrierte Auslenkung, beide −100 % bis 100 %; schattiert die Totzone</translation>
    </message>
    <message>
        <source>Buttons</source>
        <translation>Tasten</translation>
    </message>
    <message>
        <source>Down: {held}</source>
        <translation>Gedrückt: {held}</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>Response curve</source>
        <translation>Kennlinie</translation>
    </message>
    <message>
        <source>Across what the device says, upwards the deflection that comes of it</source>
        <translation>Waagerecht der Rohwert des Geräts, senkrecht die Auslenkung daraus</translation>
    </message>
    <message>
        <source>no axis is chosen: choose those that are to be measured</source>
        <extracomment>What is in use. What was changed, and is not yet in use. Of the latest measurement: axes that stay as they were, and why.</extracomment>
        <translation>keine Achse gewählt: die zu messenden wählen</translation>
    </message>
    <message>
        <source>its settings</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>axis {axis}, {where}: {reason}</source>
        <translation>Achse {axis}, {where}: {reason}</translation>
    </message>
    <message>
        <source>rests at an end</source>
        <translation>ruht am Ende</translation>
    </message>
    <message>
        <source>rests at {centre:+.2f}</source>
        <translation>ruht bei {centre:+.2f}</translation>
    </message>
    <message>
        <source>{low:+.2f} to {high:+.2f}, {rest}</source>
        <translation>{low:+.2f} bis {high:+.2f}, {rest}</translation>
    </message>
    <message>
        <source>Calibration</source>
        <translation>Kalibrierung</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Behalten</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Defaults</source>
        <translation>Standard</translation>
    </message>
    <message>
        <source>This axis as one that was never calibrated</source>
        <translation>Diese Achse wie nie kalibriert</translation>
    </message>
    <message>
        <source>Half the width of the range about the centre that counts as centred, raw</source>
        <translation>Halbe Breite des Bereichs um die Mitte, der als mittig gilt, Rohwert</translation>
    </message>
    <message>
        <source>Dead zone</source>
        <translation>Totzone</translation>
    </message>
    <message>
        <source>Expo</source>
        <translation>Expo</translation>
    </message>
    <message>
        <source>Response curve: 0 linear, 1 finest near rest</source>
        <translation>Kennlinie: 0 linear, 1 nahe der Ruhelage am feinsten</translation>
    </message>
    <message>
        <source>Travel</source>
        <translation>Weg</translation>
    </message>
    <message>
        <source>Way of the grip from rest to an end</source>
        <translation>Weg des Griffs von der Ruhelage bis zu einem Ende</translation>
    </message>
    <message>
        <source>Inverted</source>
        <translation>Umgekehrt</translation>
    </message>
    <message>
        <source>The deflection has the other sign</source>
        <translation>Die Auslenkung hat das andere Vorzeichen</translation>
    </message>
    <message>
        <source>Travel, mm</source>
        <translation>Weg, mm</translation>
    </message>
    <message>
        <source>Calibration of {name}</source>
        <translation>Kalibrierung von {name}</translation>
    </message>
    <message>
        <source>nothing was changed</source>
        <translation>nichts wurde geändert</translation>
    </message>
    <message>
        <source>Use this calibration from now on, and keep it for the device</source>
        <translation>Diese Kalibrierung ab jetzt verwenden und für das Gerät behalten</translation>
    </message>
    <message>
        <source>Go back to the calibration that is in use</source>
        <translation>Zurück zur Kalibrierung, die in Gebrauch ist</translation>
    </message>
    <message>
        <source>The changed calibration of {names} was not kept.</source>
        <translation>Die geänderte Kalibrierung von {names} wurde nicht behalten.</translation>
    </message>
    <message>
        <source> and </source>
        <translation> und </translation>
    </message>
    <message>
        <source>It has no axes: there is nothing to calibrate.</source>
        <translation>Es hat keine Achsen: nichts zu kalibrieren.</translation>
    </message>
    <message>
        <source>Says {one}.</source>
        <translation>Meldet {one}.</translation>
    </message>
    <message>
        <source>The calibration of {name} is kept.</source>
        <translation>Die Kalibrierung von {name} ist gespeichert.</translation>
    </message>
    <message>
        <source>Devices</source>
        <translation>Geräte</translation>
    </message>
    <message>
        <source>None yet. Plug one in; it is found within a second.</source>
        <translation>Noch keines. Eines anstecken; es wird binnen einer Sekunde gefunden.</translation>
    </message>
    <message>
        <source>Input devices that are plugged in</source>
        <translation>Angesteckte Eingabegeräte</translation>
    </message>
    <message>
        <source>{action}: {percent:g} % of the deflection cannot be a threshold; it must be {least:g} to 100 % one way or the other</source>
        <extracomment>What the device is to do now; None: the profile has nothing for it.</extracomment>
        <translation>{action}: {percent:g} % der Auslenkung ist keine Schwelle; erlaubt sind {least:g} bis 100 % in die eine oder andere Richtung</translation>
    </message>
    <message>
        <source>profile {profile!r} would be left without any device; map another one first, or choose another profile</source>
        <translation>Profil {profile!r} bliebe ohne Gerät; zuerst ein anderes belegen oder ein anderes Profil wählen</translation>
    </message>
    <message>
        <source>move the axis now</source>
        <translation>jetzt die Achse bewegen</translation>
    </message>
    <message>
        <source>press the button, or move the axis, now</source>
        <translation>jetzt die Taste drücken oder die Achse bewegen</translation>
    </message>
    <message>
        <source>Axis {name}: raw, calibrated</source>
        <translation>Achse {name}: roh, kalibriert</translation>
    </message>
    <message>
        <source>What the device says, −1 to 1, and the calibrated deflection</source>
        <translation>Rohwert des Geräts, −1 bis 1, und die kalibrierte Auslenkung</translation>
    </message>
    <message>
        <source>Live</source>
        <translation>Live</translation>
    </message>
    <message>
        <source>Old: the devices were read {age_s:.1f} s ago. Nothing is steered by them.</source>
        <translation>Veraltet: die Geräte wurden vor {age_s:.1f} s gelesen. Nichts wird durch sie gesteuert.</translation>
    </message>
    <message>
        <source>It has neither axes nor buttons.</source>
        <translation>Es hat weder Achsen noch Tasten.</translation>
    </message>
    <message>
        <source>Control of: {name}</source>
        <translation>Bedienelement von: {name}</translation>
    </message>
    <message>
        <source>Clear: {name}</source>
        <translation>Löschen: {name}</translation>
    </message>
    <message>
        <source>move it now …</source>
        <translation>jetzt bewegen …</translation>
    </message>
    <message>
        <source>Press this, then move the control that is to do it</source>
        <translation>Hier drücken, dann das Bedienelement bewegen, das es tun soll</translation>
    </message>
    <message>
        <source>nothing does it</source>
        <translation>nichts tut es</translation>
    </message>
    <message>
        <source>{name}: by nothing</source>
        <translation>{name}: durch nichts</translation>
    </message>
    <message>
        <source>Inverted: {name}</source>
        <translation>Umgekehrt: {name}</translation>
    </message>
    <message>
        <source>Inverted: the other way than its calibration says</source>
        <translation>Umgekehrt: entgegen seiner Kalibrierung</translation>
    </message>
    <message>
        <source>Threshold of: {name}</source>
        <translation>Schwelle von: {name}</translation>
    </message>
    <message>
        <source>Deflection from which the axis counts as pressed, not between −10 and 10</source>
        <translation>Auslenkung, ab der die Achse als gedrückt gilt, nicht zwischen −10 und 10</translation>
    </message>
    <message>
        <source>Press a field, then move the control that is to do it.</source>
        <translation>Ein Feld drücken, dann das Bedienelement bewegen, das es tun soll.</translation>
    </message>
    <message>
        <source>Trainer</source>
        <translation>Trainer</translation>
    </message>
    <message>
        <source>Trainee</source>
        <translation>Trainee</translation>
    </message>
    <message>
        <source>Does nothing</source>
        <translation>Tut nichts</translation>
    </message>
    <message>
        <source>Mapping</source>
        <translation>Belegung</translation>
    </message>
    <message>
        <source>Seat of the device</source>
        <translation>Platz des Geräts</translation>
    </message>
    <message>
        <source>Exchange seats</source>
        <translation>Plätze tauschen</translation>
    </message>
    <message>
        <source>Mapping of {device}</source>
        <translation>Belegung von {device}</translation>
    </message>
    <message>
        <source>all devices of the profile are at one seat</source>
        <translation>alle Geräte des Profils gehören zu einem Platz</translation>
    </message>
    <message>
        <source>The trainer&apos;s devices become the trainee&apos;s, and theirs his</source>
        <translation>Die Geräte von Trainer und Trainee werden getauscht</translation>
    </message>
    <message>
        <source>{name}: {message}, {target}. Press again to cancel.</source>
        <translation>{name}: {message}, {target}. Erneut drücken zum Abbrechen.</translation>
    </message>
    <message>
        <source>{name}: {message}. Press again to cancel.</source>
        <translation>{name}: {message}. Erneut drücken zum Abbrechen.</translation>
    </message>
    <message>
        <source>Refused: {error}</source>
        <translation>Abgelehnt: {error}</translation>
    </message>
    <message>
        <source>Choose the axes to measure. Tick those that rest at an end: triggers, pedals.</source>
        <translation>Zu messende Achsen wählen. Jene ankreuzen, die am Ende ruhen: Abzüge, Pedale.</translation>
    </message>
    <message>
        <source>1 of 2: let go of the device, and leave it alone.</source>
        <translation>1 von 2: Gerät loslassen und ruhen lassen.</translation>
    </message>
    <message>
        <source>2 of 2: move each axis to all its ends, some times.</source>
        <translation>2 von 2: jede Achse mehrmals an alle Enden bewegen.</translation>
    </message>
    <message>
        <source>Measure …</source>
        <translation>Messen …</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Left as they were:
</source>
        <translation>Blieben wie sie waren:
</translation>
    </message>
    <message>
        <source>none is ticked</source>
        <translation>keine ist angekreuzt</translation>
    </message>
    <message>
        <source>Measure rest and ends of the ticked axes</source>
        <translation>Ruhelage und Enden der angekreuzten Achsen messen</translation>
    </message>
    <message>
        <source>It rests: next</source>
        <translation>Ruht: weiter</translation>
    </message>
    <message>
        <source>{left_s:.1f} s …</source>
        <translation>{left_s:.1f} s …</translation>
    </message>
    <message>
        <source>its noise is measured</source>
        <translation>das Rauschen wird gemessen</translation>
    </message>
    <message>
        <source>Go on to the ends</source>
        <translation>Weiter zu den Enden</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>Fertig</translation>
    </message>
    <message>
        <source>Done, without these</source>
        <translation>Fertig, ohne diese</translation>
    </message>
    <message>
        <source>Take over what was measured well</source>
        <translation>Übernehmen, was gut gemessen wurde</translation>
    </message>
    <message>
        <source>Measure axis {axis}</source>
        <translation>Achse {axis} messen</translation>
    </message>
    <message>
        <source>Axis {axis} rests at an end</source>
        <translation>Achse {axis} ruht am Ende</translation>
    </message>
    <message>
        <source>{low:g} to {high:g} {unit}</source>
        <translation>{low:g} bis {high:g} {unit}</translation>
    </message>
    <message>
        <source>, or nothing</source>
        <translation>, oder leer</translation>
    </message>
    <message>
        <source>{text!r} is no number; type one with a decimal point, {bounds}</source>
        <translation>{text!r} ist keine Zahl; eine mit Dezimalkomma eingeben, {bounds}</translation>
    </message>
    <message>
        <source>{value} is refused: must be {bounds}</source>
        <translation>{value} wird abgelehnt: erlaubt {bounds}</translation>
    </message>
    <message>
        <source>Set up …</source>
        <translation>Einrichten …</translation>
    </message>
    <message>
        <source>Map and calibrate; meanwhile nothing is sent but stops</source>
        <translation>Belegen und kalibrieren; derweil wird außer Halt nichts gesendet</translation>
    </message>
    <message>
        <source>What is set up</source>
        <translation>Was eingerichtet wird</translation>
    </message>
    <message>
        <source>Leave the set-up</source>
        <extracomment>Made when somebody sets up for the first time: most who open the window never do.</extracomment>
        <translation>Einrichten beenden</translation>
    </message>
    <message>
        <source>save or discard the changes first</source>
        <translation>zuerst die Änderungen speichern oder verwerfen</translation>
    </message>
    <message>
        <source>Profile</source>
        <translation>Profil</translation>
    </message>
    <message>
        <source>Refresh the profiles</source>
        <translation>Profile neu suchen</translation>
    </message>
    <message>
        <source>Refresh the folder of profiles</source>
        <translation>Erneut in den Profilordner sehen</translation>
    </message>
    <message>
        <source>Name to keep the profile under</source>
        <translation>Name, unter dem das Profil gespeichert wird</translation>
    </message>
    <message>
        <source>Letters, digits, blanks and ( ) . , + - _; at most 60</source>
        <translation>Buchstaben, Ziffern, Leerzeichen und ( ) . , + - _; höchstens 60</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>Keep the profile under this name, and use it from now on</source>
        <translation>Profil unter diesem Namen speichern und ab jetzt verwenden</translation>
    </message>
    <message>
        <source>Go back to the profile as it was chosen</source>
        <translation>Zurück zum Profil, wie es gewählt wurde</translation>
    </message>
    <message>
        <source>What the controls do</source>
        <translation>Was die Bedienelemente tun</translation>
    </message>
    <message>
        <source>there is no profile: map a control first</source>
        <translation>kein Profil: zuerst ein Bedienelement belegen</translation>
    </message>
    <message>
        <source>Input devices: profile {name!r} is kept.</source>
        <translation>Eingabegeräte: Profil {name!r} ist gespeichert.</translation>
    </message>
    <message>
        <source>Overwrite</source>
        <translation>Überschreiben</translation>
    </message>
    <message>
        <source>There is a profile {name!r} already. Overwrite it?</source>
        <translation>Ein Profil {name!r} gibt es schon. Überschreiben?</translation>
    </message>
    <message>
        <source>save it</source>
        <translation>speichern</translation>
    </message>
    <message>
        <source>set up, and save it</source>
        <translation>einrichten und speichern</translation>
    </message>
    <message>
        <source>Changed, and not kept: {where}, or it is lost when the program ends.</source>
        <translation>Geändert, nicht gespeichert: {where}, sonst geht es beim Beenden verloren.</translation>
    </message>
    <message>
        <source>In use: {name}</source>
        <translation>In Gebrauch: {name}</translation>
    </message>
    <message>
        <source>Input devices: {error}. An automatic profile is used instead.</source>
        <extracomment>What was chosen: the name of a file, or automatic. Whether what is used was changed since, and no file has it.</extracomment>
        <translation>Eingabegeräte: {error}. Stattdessen wird ein automatisches Profil verwendet.</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>there is no profile to keep: map a control first</source>
        <translation>kein Profil zu speichern: zuerst ein Bedienelement belegen</translation>
    </message>
    <message>
        <source>there is no profile {name!r} any more</source>
        <translation>ein Profil {name!r} gibt es nicht mehr</translation>
    </message>
    <message>
        <source>{file}: it cannot be read</source>
        <translation>{file}: nicht lesbar</translation>
    </message>
    <message>
        <source>{name} – cannot be used</source>
        <translation>{name} – nicht verwendbar</translation>
    </message>
    <message>
        <source>{name} – not for this robot</source>
        <translation>{name} – nicht für diesen Roboter</translation>
    </message>
    <message>
        <source>{name!r} cannot be the name of a profile: it must begin with a letter or digit and have at most 60 letters, digits, blanks and ( ) . , + - _</source>
        <translation>{name!r} kann kein Profilname sein: er beginnt mit Buchstabe oder Ziffer und hat höchstens 60 Buchstaben, Ziffern, Leerzeichen und ( ) . , + - _</translation>
    </message>
    <message>
        <source>Nothing is sent to the robot while you set up, but stops.</source>
        <translation>Beim Einrichten wird außer Halt nichts an den Roboter gesendet.</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Halt</translation>
    </message>
    <message>
        <source>Stop and lock</source>
        <translation>Halt und sperren</translation>
    </message>
    <message>
        <source>Dead-man</source>
        <translation>Zustimmung</translation>
    </message>
    <message>
        <source>Clutch</source>
        <translation>Kuppeln</translation>
    </message>
    <message>
        <source>Fine</source>
        <translation>Fein</translation>
    </message>
    <message>
        <source>Coarse</source>
        <translation>Grob</translation>
    </message>
    <message>
        <source>Next mode</source>
        <translation>Modus ▸</translation>
    </message>
    <message>
        <source>Next law</source>
        <translation>Gesetz ▸</translation>
    </message>
    <message>
        <source>Next preset</source>
        <translation>Skala ▸</translation>
    </message>
    <message>
        <source>Re-centre</source>
        <translation>Zentrieren</translation>
    </message>
    <message>
        <source>Penetration</source>
        <translation>Penetration</translation>
    </message>
    <message>
        <source>Tool on/off</source>
        <translation>Werkzeug</translation>
    </message>
    <message>
        <source>Take over</source>
        <translation>Übernehmen</translation>
    </message>
    <message>
        <source>Stop all axes; works from every device, at any time</source>
        <translation>Alle Achsen anhalten; wirkt von jedem Gerät, jederzeit</translation>
    </message>
    <message>
        <source>Stop all axes, and latch; works from every device, at any time</source>
        <translation>Alle Achsen anhalten und verriegeln; wirkt von jedem Gerät, jederzeit</translation>
    </message>
    <message>
        <source>The stick acts only while this is held</source>
        <translation>Der Knüppel wirkt nur, solange dies gehalten wird</translation>
    </message>
    <message>
        <source>The stick moves, and the robot does not, while this is held</source>
        <translation>Solange gehalten, bewegt sich der Knüppel, der Roboter nicht</translation>
    </message>
    <message>
        <source>A tenth of the scale while this is held</source>
        <translation>Ein Zehntel der Skalierung, solange gehalten</translation>
    </message>
    <message>
        <source>Ten times the scale while this is held</source>
        <translation>Zehnfache Skalierung, solange gehalten</translation>
    </message>
    <message>
        <source>Micro, nano, and on to the next mode of steering</source>
        <translation>Mikro, Nano und weiter zum nächsten Steuermodus</translation>
    </message>
    <message>
        <source>The next scaling law</source>
        <translation>Das nächste Skalierungsgesetz</translation>
    </message>
    <message>
        <source>The next scale</source>
        <translation>Die nächste Skalierung</translation>
    </message>
    <message>
        <source>The piezos back to their middle</source>
        <translation>Die Piezos zurück in ihre Mitte</translation>
    </message>
    <message>
        <source>Start the automatic penetration, or stop it</source>
        <translation>Automatische Penetration starten oder anhalten</translation>
    </message>
    <message>
        <source>Tool on or off</source>
        <translation>Werkzeug ein oder aus</translation>
    </message>
    <message>
        <source>Of two seats: this one drives now</source>
        <translation>Von zwei Plätzen: dieser steuert jetzt</translation>
    </message>
    <message>
        <source>to the right (+x)</source>
        <translation>nach rechts (+x)</translation>
    </message>
    <message>
        <source>away from you (+y)</source>
        <translation>vom Körper weg (+y)</translation>
    </message>
    <message>
        <source>upwards (+z)</source>
        <translation>nach oben (+z)</translation>
    </message>
    <message>
        <source>trainer</source>
        <translation>Trainer</translation>
    </message>
    <message>
        <source>trainee</source>
        <translation>Trainee</translation>
    </message>
    <message>
        <source>pad</source>
        <extracomment>What the pad on the screen and its buttons are called.</extracomment>
        <translation>Bildschirmfeld</translation>
    </message>
    <message>
        <source>clutch</source>
        <translation>Kupplung</translation>
    </message>
    <message>
        <source>fine</source>
        <translation>fein</translation>
    </message>
    <message>
        <source>coarse</source>
        <translation>grob</translation>
    </message>
    <message>
        <source>take_over</source>
        <translation>Übernehmen</translation>
    </message>
    <message>
        <source>Stick {name}</source>
        <translation>Knüppel {name}</translation>
    </message>
    <message>
        <source> or </source>
        <translation> oder </translation>
    </message>
    <message>
        <source>Moves {axes}, by the mode of steering</source>
        <translation>Bewegt {axes}, je nach Steuermodus</translation>
    </message>
    <message>
        <source>Moves {target} directly, whatever the mode</source>
        <translation>Bewegt {target} direkt, in jedem Modus</translation>
    </message>
    <message>
        <source>the way in which {target} is to grow</source>
        <translation>in die Richtung, in der {target} wachsen soll</translation>
    </message>
    <message>
        <source>cannot be used</source>
        <translation>nicht verwendbar</translation>
    </message>
    <message>
        <source>Being set up: nothing drives.</source>
        <translation>Wird eingerichtet: nichts steuert.</translation>
    </message>
    <message>
        <source>One problem, see below.</source>
        <translation>Ein Problem, siehe unten.</translation>
    </message>
    <message>
        <source>{wrong} problems, see below.</source>
        <translation>{wrong} Probleme, siehe unten.</translation>
    </message>
    <message>
        <source>No input device is plugged in.</source>
        <translation>Kein Eingabegerät angesteckt.</translation>
    </message>
    <message>
        <source>{names} may drive{seat}.</source>
        <translation>{names} darf steuern{seat}.</translation>
    </message>
    <message>
        <source>No device of the driving seat is there.</source>
        <translation>Kein Gerät des steuernden Platzes ist da.</translation>
    </message>
    <message>
        <source>not in the profile</source>
        <translation>nicht im Profil</translation>
    </message>
    <message>
        <source>{seat}, being set up</source>
        <translation>{seat}, wird eingerichtet</translation>
    </message>
    <message>
        <source>trainee, looks on</source>
        <translation>Trainee, sieht zu</translation>
    </message>
    <message>
        <source>trainer, may take over</source>
        <translation>Trainer, darf übernehmen</translation>
    </message>
    <message>
        <source>{seat}, waits for {waiting}</source>
        <translation>{seat}, wartet auf {waiting}</translation>
    </message>
    <message>
        <source>{seat}, drives</source>
        <translation>{seat}, steuert</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Input devices</source>
        <translation>Eingabegeräte</translation>
    </message>
</context>
</TS>
