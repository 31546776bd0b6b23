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
        <source>Buttons</source>
        <translation>Tasten</translation>
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
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Defaults</source>
        <translation>Standard</translation>
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
        <translation>Hub</translation>
    </message>
    <message>
        <source>Inverted</source>
        <translation>Umgekehrt</translation>
    </message>
    <message>
        <source>Travel, mm</source>
        <translation>Hub, mm</translation>
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
        <source> and </source>
        <translation> und </translation>
    </message>
    <message>
        <source>Devices</source>
        <translation>Geräte</translation>
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
        <source>Live</source>
        <translation>Live</translation>
    </message>
    <message>
        <source>Reports not understood: {count}. The latest: {fault}</source>
        <translation>Nicht verstandene Meldungen: {count}. Die letzte: {fault}</translation>
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
        <source>Inverted: {name}</source>
        <translation>Umgekehrt: {name}</translation>
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
        <source>Trainer</source>
        <translation>Trainer</translation>
    </message>
    <message>
        <source>Trainee</source>
        <translation>Trainee</translation>
    </message>
    <message>
        <source>When silent: stop</source>
        <translation>Wenn es schweigt: anhalten</translation>
    </message>
    <message>
        <source>Held still, the device must report at least once a second, or it counts as released.</source>
        <translation>Ruhig gehalten muss das Gerät mindestens einmal je Sekunde melden, sonst gilt es als losgelassen.</translation>
    </message>
    <message>
        <source>When silent: continue</source>
        <translation>Wenn es schweigt: weiterfahren</translation>
    </message>
    <message>
        <source>The robot continues while the device is silent, even if its link has failed. Only for a device on a cable that reports nothing while it is held still.</source>
        <translation>Der Roboter fährt weiter, während das Gerät schweigt, selbst wenn seine Verbindung ausgefallen ist. Nur für ein Gerät am Kabel, das ruhig gehalten nichts meldet.</translation>
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
        <source>When the device is silent</source>
        <translation>Wenn das Gerät schweigt</translation>
    </message>
    <message>
        <source>Mapping of {device}</source>
        <translation>Belegung von {device}</translation>
    </message>
    <message>
        <source>the device has no action yet</source>
        <translation>das Gerät hat noch keine Aktion</translation>
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
        <source>Measure …</source>
        <translation>Messen …</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Measure rest and ends of the ticked axes</source>
        <translation>Ruhelage und Enden der angekreuzten Achsen messen</translation>
    </message>
    <message>
        <source>{left_s:.1f} s …</source>
        <translation>{left_s:.1f} s …</translation>
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
        <source>Set up …</source>
        <translation>Einrichten …</translation>
    </message>
    <message>
        <source>Leave the set-up</source>
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
        <source>Letters, digits, blanks and ( ) . , + - _; at most 60</source>
        <translation>Buchstaben, Ziffern, Leerzeichen und ( ) . , + - _; höchstens 60</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>there is no profile: map a control first</source>
        <translation>kein Profil: zuerst ein Bedienelement belegen</translation>
    </message>
    <message>
        <source>Overwrite</source>
        <translation>Überschreiben</translation>
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
        <source>In use: {name}</source>
        <translation>Verwendet: {name}</translation>
    </message>
    <message>
        <source>Input devices: {error}. An automatic profile is used instead.</source>
        <translation>Eingabegeräte: {error}. Stattdessen wird ein automatisches Profil verwendet.</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>there is no profile {name!r} any more</source>
        <translation>ein Profil {name!r} gibt es nicht mehr</translation>
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
        <source>Stop</source>
        <translation>Halt</translation>
    </message>
    <message>
        <source>Stop and lock</source>
        <translation>Halt und sperren</translation>
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
        <translation>Maßstab ▸</translation>
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
        <source>Tool on or off</source>
        <translation>Werkzeug ein oder aus</translation>
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
        <translation>übernehmen</translation>
    </message>
    <message>
        <source>Stick {name}</source>
        <translation>Joystick {name}</translation>
    </message>
    <message>
        <source> or </source>
        <translation> oder </translation>
    </message>
    <message>
        <source>cannot be used</source>
        <translation>nicht verwendbar</translation>
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
        <source>not in the profile</source>
        <translation>nicht im Profil</translation>
    </message>
    <message>
        <source>{seat}, being set up</source>
        <translation>{seat}, wird eingerichtet</translation>
    </message>
    <message>
        <source>trainer, may take over</source>
        <translation>Trainer, darf übernehmen</translation>
    </message>
    <message>
        <source>{action}: the threshold of {percent:g} % of the deflection must be {least:g} to 100 % in either direction</source>
        <translation>{action}: die Schwelle von {percent:g} % der Auslenkung muss {least:g} bis 100 % in eine der Richtungen betragen</translation>
    </message>
    <message>
        <source>profile {profile!r} would have no device; map another device first, or choose another profile</source>
        <translation>Profil {profile!r} hätte kein Gerät mehr; zuerst ein anderes belegen oder ein anderes Profil wählen</translation>
    </message>
    <message>
        <source>During set-up only stops are sent to the robot.</source>
        <translation>Während der Einrichtung wird nur Halt an den Roboter gesendet.</translation>
    </message>
    <message>
        <source>Stop all axes; works from every device at any time</source>
        <translation>Alle Achsen anhalten; wirkt jederzeit von jedem Gerät</translation>
    </message>
    <message>
        <source>Stop all axes and lock; works from every device at any time</source>
        <translation>Alle Achsen anhalten und sperren; wirkt jederzeit von jedem Gerät</translation>
    </message>
    <message>
        <source>The stick acts only while this is pressed</source>
        <translation>Der Joystick wirkt nur, solange dies gedrückt ist</translation>
    </message>
    <message>
        <source>While this is pressed, the stick moves without the robot</source>
        <translation>Solange dies gedrückt ist, bewegt sich der Joystick ohne den Roboter</translation>
    </message>
    <message>
        <source>A tenth of the scale while this is pressed</source>
        <translation>Ein Zehntel des Maßstabs, solange dies gedrückt ist</translation>
    </message>
    <message>
        <source>Ten times the scale while this is pressed</source>
        <translation>Zehnfacher Maßstab, solange dies gedrückt ist</translation>
    </message>
    <message>
        <source>Next control mode: micro, nano and so on</source>
        <translation>Nächster Modus: Mikro, Nano und so weiter</translation>
    </message>
    <message>
        <source>Next scaling law</source>
        <translation>Nächstes Skalierungsgesetz</translation>
    </message>
    <message>
        <source>Next scale preset</source>
        <translation>Nächster Maßstab</translation>
    </message>
    <message>
        <source>Move the piezos back to mid-range</source>
        <translation>Die Piezos zurück in die Mitte fahren</translation>
    </message>
    <message>
        <source>Start or stop the automatic penetration</source>
        <translation>Die automatische Penetration starten oder anhalten</translation>
    </message>
    <message>
        <source>This seat takes over control</source>
        <translation>Dieser Platz übernimmt die Steuerung</translation>
    </message>
    <message>
        <source>Set-up: no device controls the robot.</source>
        <translation>Einrichtung: kein Gerät steuert.</translation>
    </message>
    <message>
        <source>No input device is connected.</source>
        <translation>Kein Eingabegerät ist angeschlossen.</translation>
    </message>
    <message>
        <source>No device of the controlling seat is connected.</source>
        <translation>Kein Gerät des steuernden Platzes ist angeschlossen.</translation>
    </message>
    <message>
        <source>Moves {target} directly in any mode</source>
        <translation>Bewegt {target} direkt, in jedem Modus</translation>
    </message>
    <message>
        <source>the direction of increasing {target}</source>
        <translation>die Richtung, in der {target} wächst</translation>
    </message>
    <message>
        <source>trainee, watching</source>
        <translation>Trainee, sieht zu</translation>
    </message>
    <message>
        <source>Moves {axes}, depending on the control mode</source>
        <translation>Bewegt {axes}, je nach Modus</translation>
    </message>
    <message>
        <source>{names} may control the robot{seat}.</source>
        <translation>{names} darf den Roboter steuern{seat}.</translation>
    </message>
    <message>
        <source>{seat}, waiting for {waiting}</source>
        <translation>{seat}, wartet auf {waiting}</translation>
    </message>
    <message>
        <source>{seat}, in control</source>
        <translation>{seat}, steuert</translation>
    </message>
    <message>
        <source>Half width of the range around the centre that counts as centred, raw value</source>
        <translation>Halbe Breite des Bereichs um die Mitte, der als mittig gilt, Rohwert</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Anwenden</translation>
    </message>
    <message>
        <source>Reset this axis to the uncalibrated state</source>
        <translation>Diese Achse auf den unkalibrierten Zustand zurücksetzen</translation>
    </message>
    <message>
        <source>Distance of the grip from rest to either end</source>
        <translation>Abstand des Griffs von der Ruhelage bis zu einem Ende</translation>
    </message>
    <message>
        <source>Reverse the sign of the deflection</source>
        <translation>Das Vorzeichen der Auslenkung umkehren</translation>
    </message>
    <message>
        <source>Use this calibration from now on and store it for the device</source>
        <translation>Diese Kalibrierung ab jetzt verwenden und für das Gerät speichern</translation>
    </message>
    <message>
        <source>Restore the calibration in use</source>
        <translation>Die verwendete Kalibrierung wiederherstellen</translation>
    </message>
    <message>
        <source>The device has no axes: there is nothing to calibrate.</source>
        <translation>Das Gerät hat keine Achsen: nichts zu kalibrieren.</translation>
    </message>
    <message>
        <source>The device reports {one}.</source>
        <translation>Das Gerät meldet {one}.</translation>
    </message>
    <message>
        <source>The changed calibration of {names} was not stored.</source>
        <translation>Die geänderte Kalibrierung von {names} wurde nicht gespeichert.</translation>
    </message>
    <message>
        <source>The calibration of {name} is stored.</source>
        <translation>Die Kalibrierung von {name} ist gespeichert.</translation>
    </message>
    <message>
        <source>Horizontal: raw value of the device; vertical: the resulting deflection</source>
        <translation>Waagerecht: Rohwert des Geräts; senkrecht: Auslenkung daraus</translation>
    </message>
    <message>
        <source>{name}: raw value of the device (thin) and calibrated deflection (thick), −100 % to 100 %; the dead zone is shaded</source>
        <translation>{name}: Rohwert des Geräts (dünn) und kalibrierte Auslenkung (dick), −100 % bis 100 %; die Totzone ist schattiert</translation>
    </message>
    <message>
        <source>Pressed: {held}</source>
        <translation>Gedrückt: {held}</translation>
    </message>
    <message>
        <source>Map and calibrate; meanwhile only stops are sent</source>
        <translation>Belegen und kalibrieren; währenddessen wird nur Halt gesendet</translation>
    </message>
    <message>
        <source>Section of the set-up</source>
        <translation>Teil der Einrichtung</translation>
    </message>
    <message>
        <source>Press this field, then move the control for this action</source>
        <translation>Dieses Feld drücken, dann das Bedienelement für diese Aktion bewegen</translation>
    </message>
    <message>
        <source>Inverted: opposite to the calibration</source>
        <translation>Umgekehrt: entgegen der Kalibrierung</translation>
    </message>
    <message>
        <source>move it …</source>
        <translation>bewegen …</translation>
    </message>
    <message>
        <source>not mapped</source>
        <translation>nicht belegt</translation>
    </message>
    <message>
        <source>{name}: not mapped</source>
        <translation>{name}: nicht belegt</translation>
    </message>
    <message>
        <source>Read the folder of profiles again</source>
        <translation>Den Ordner der Profile neu lesen</translation>
    </message>
    <message>
        <source>Name of the profile</source>
        <translation>Name des Profils</translation>
    </message>
    <message>
        <source>Save the profile under this name and use it from now on</source>
        <translation>Das Profil unter diesem Namen speichern und ab jetzt verwenden</translation>
    </message>
    <message>
        <source>Discard the changes of the profile</source>
        <translation>Die Änderungen am Profil verwerfen</translation>
    </message>
    <message>
        <source>Functions of the controls</source>
        <translation>Funktionen der Bedienelemente</translation>
    </message>
    <message>
        <source>Profile {name!r} already exists. Overwrite it?</source>
        <translation>Profil {name!r} gibt es schon. Überschreiben?</translation>
    </message>
    <message>
        <source>Changed, but not saved: {where}, or the change is lost when the program ends.</source>
        <translation>Geändert, aber nicht gespeichert: {where}, sonst geht die Änderung beim Beenden verloren.</translation>
    </message>
    <message>
        <source>Input devices: profile {name!r} is saved.</source>
        <translation>Eingabegeräte: Profil {name!r} ist gespeichert.</translation>
    </message>
    <message>
        <source>The device has neither axes nor buttons.</source>
        <translation>Das Gerät hat weder Achsen noch Tasten.</translation>
    </message>
    <message>
        <source>Raw value of the device, −1 to 1, and calibrated deflection</source>
        <translation>Rohwert des Geräts, −1 bis 1, und kalibrierte Auslenkung</translation>
    </message>
    <message>
        <source>Outdated: the devices were last read {age_s:.1f} s ago. They do not control any axis.</source>
        <translation>Veraltet: die Geräte wurden zuletzt vor {age_s:.1f} s gelesen. Sie steuern keine Achse.</translation>
    </message>
    <message>
        <source>Choose the axes to measure. Tick the ones that rest at an end, such as triggers and pedals.</source>
        <translation>Die zu messenden Achsen wählen. Jene ankreuzen, die am Ende ruhen, etwa Abzüge und Pedale.</translation>
    </message>
    <message>
        <source>1 of 2: release the device and do not touch it.</source>
        <translation>1 von 2: das Gerät loslassen und nicht berühren.</translation>
    </message>
    <message>
        <source>2 of 2: move each axis several times to both ends.</source>
        <translation>2 von 2: jede Achse mehrmals an beide Enden bewegen.</translation>
    </message>
    <message>
        <source>Unchanged:
</source>
        <translation>Unverändert:
</translation>
    </message>
    <message>
        <source>no axis is ticked</source>
        <translation>keine Achse ist angekreuzt</translation>
    </message>
    <message>
        <source>Continue with the ends</source>
        <translation>Weiter zu den Enden</translation>
    </message>
    <message>
        <source>Use the successful measurements</source>
        <translation>Die gelungenen Messungen übernehmen</translation>
    </message>
    <message>
        <source>At rest: next</source>
        <translation>In Ruhe: weiter</translation>
    </message>
    <message>
        <source>measuring the noise</source>
        <translation>das Rauschen wird gemessen</translation>
    </message>
    <message>
        <source>there is no profile to save: map a control first</source>
        <translation>kein Profil zu speichern: zuerst ein Bedienelement belegen</translation>
    </message>
    <message>
        <source>{file}: cannot be read</source>
        <translation>{file}: nicht lesbar</translation>
    </message>
    <message>
        <source>, or empty</source>
        <translation>, oder leer</translation>
    </message>
    <message>
        <source>{text!r} is not a number; enter one with a decimal point, {bounds}</source>
        <translation>{text!r} ist keine Zahl; eine mit Dezimalkomma eingeben, {bounds}</translation>
    </message>
    <message>
        <source>{value} is outside {bounds}</source>
        <translation>{value} liegt außerhalb von {bounds}</translation>
    </message>
    <message>
        <source>No device. A device that is plugged in appears within a second.</source>
        <translation>Kein Gerät. Ein angestecktes Gerät erscheint binnen einer Sekunde.</translation>
    </message>
    <message>
        <source>Connected input devices</source>
        <translation>Angeschlossene Eingabegeräte</translation>
    </message>
    <message>
        <source>Press a field, then move the control for its action.</source>
        <translation>Ein Feld drücken, dann das Bedienelement für seine Aktion bewegen.</translation>
    </message>
    <message>
        <source>No action</source>
        <translation>Keine Aktion</translation>
    </message>
    <message>
        <source>all devices of the profile belong to one seat</source>
        <translation>alle Geräte des Profils gehören zu einem Platz</translation>
    </message>
    <message>
        <source>Exchange the devices of trainer and trainee</source>
        <translation>Die Geräte von Trainer und Trainee tauschen</translation>
    </message>
    <message>
        <source>no axis is chosen: choose the axes to measure</source>
        <translation>keine Achse gewählt: die zu messenden wählen</translation>
    </message>
    <message>
        <source>Dead-man</source>
        <translation>Zustimmung</translation>
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
