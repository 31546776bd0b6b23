<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>effects</name>
    <message>
        <source>Formulation</source>
        <translation>Ansatz</translation>
    </message>
    <message>
        <source>from</source>
        <translation>von</translation>
    </message>
    <message>
        <source>Must be {range}</source>
        <translation>Muss {range} sein</translation>
    </message>
    <message>
        <source>Preset {value}</source>
        <translation>Vorgabe {value}</translation>
    </message>
    <message>
        <source>not connected</source>
        <translation>nicht verbunden</translation>
    </message>
    <message>
        <source>Left out ({n})</source>
        <translation>Ausgelassen ({n})</translation>
    </message>
    <message>
        <source>Add effect</source>
        <translation>Hinzufügen</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>All off</source>
        <translation>Alle aus</translation>
    </message>
    <message>
        <source>Load …</source>
        <translation>Laden …</translation>
    </message>
    <message>
        <source>Save robot …</source>
        <translation>Speichern …</translation>
    </message>
    <message>
        <source>{n} left out</source>
        <translation>{n} ausgelassen</translation>
    </message>
    <message>
        <source>Effects that cannot be loaded:</source>
        <translation>Effekte, die sich nicht laden lassen:</translation>
    </message>
    <message>
        <source>Effects of a machine after years of use</source>
        <translation>Effekte einer Maschine nach Jahren des Gebrauchs</translation>
    </message>
    <message>
        <source>Load effects from a robot file</source>
        <translation>Effekte aus einer Roboterdatei laden</translation>
    </message>
    <message>
        <source>Save the robot with its effects</source>
        <translation>Den Roboter mit seinen Effekten speichern</translation>
    </message>
    <message>
        <source>Robot files (*.toml)</source>
        <translation>Roboterdateien (*.toml)</translation>
    </message>
    <message>
        <source>no device is connected</source>
        <translation>kein Gerät ist verbunden</translation>
    </message>
    <message>
        <source>no effect is chosen</source>
        <translation>kein Effekt ist gewählt</translation>
    </message>
    <message>
        <source>nothing was changed</source>
        <translation>nichts wurde geändert</translation>
    </message>
    <message>
        <source>Not applied: {reason}</source>
        <translation>Nicht übernommen: {reason}</translation>
    </message>
    <message>
        <source>preparing …</source>
        <translation>wird vorbereitet …</translation>
    </message>
    <message>
        <source>No effects: nominal</source>
        <translation>Keine Effekte: nominal</translation>
    </message>
    <message>
        <source>all off</source>
        <translation>alle aus</translation>
    </message>
    <message>
        <source>{n} on</source>
        <translation>{n} an</translation>
    </message>
    <message>
        <source>1 effect, {state}</source>
        <translation>1 Effekt, {state}</translation>
    </message>
    <message>
        <source>{n} effects, {state}</source>
        <translation>{n} Effekte, {state}</translation>
    </message>
    <message>
        <source>at least {low}</source>
        <translation>mindestens {low}</translation>
    </message>
    <message>
        <source>between {low} and {high}</source>
        <translation>zwischen {low} und {high}</translation>
    </message>
    <message>
        <source>On</source>
        <translation>An</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>Stage</source>
        <translation>Stufe</translation>
    </message>
    <message>
        <source>Effect</source>
        <translation>Effekt</translation>
    </message>
    <message>
        <source>{formulation}, from {axis}</source>
        <translation>{formulation}, von {axis}</translation>
    </message>
    <message>
        <source>electronics</source>
        <translation>Elektronik</translation>
    </message>
    <message>
        <source>actuator</source>
        <translation>Aktor</translation>
    </message>
    <message>
        <source>mechanics</source>
        <translation>Mechanik</translation>
    </message>
    <message>
        <source>sensor</source>
        <translation>Sensor</translation>
    </message>
    <message>
        <source>Amplifier lag</source>
        <translation>Verstärkerverzögerung</translation>
    </message>
    <message>
        <source>Phase and gain both fall with frequency; a recorded u shows it.</source>
        <translation>Phase und Verstärkung fallen mit der Frequenz; ein aufgezeichnetes u zeigt es.</translation>
    </message>
    <message>
        <source>Delay</source>
        <translation>Totzeit</translation>
    </message>
    <message>
        <source>The phase grows with frequency while the gain stays 1.</source>
        <translation>Die Phase wächst mit der Frequenz, die Verstärkung bleibt 1.</translation>
    </message>
    <message>
        <source>Quantization</source>
        <translation>Quantisierung</translation>
    </message>
    <message>
        <source>The response comes in steps, which the mechanics filter.</source>
        <translation>Die Antwort kommt in Stufen, die die Mechanik filtert.</translation>
    </message>
    <message>
        <source>Saturation</source>
        <translation>Sättigung</translation>
    </message>
    <message>
        <source>The output cannot reach the command, only near the ends of the range.</source>
        <translation>Der Ausgang erreicht den Sollwert nicht, nur nahe den Bereichsenden.</translation>
    </message>
    <message>
        <source>Slew limit</source>
        <translation>Anstiegsbegrenzung</translation>
    </message>
    <message>
        <source>Creep</source>
        <translation>Kriechen</translation>
    </message>
    <message>
        <source>Gain error</source>
        <translation>Verstärkungsfehler</translation>
    </message>
    <message>
        <source>Proportional to the command, without memory.</source>
        <translation>Proportional zum Sollwert, ohne Gedächtnis.</translation>
    </message>
    <message>
        <source>Hysteresis</source>
        <translation>Hysterese</translation>
    </message>
    <message>
        <source>Lost steps</source>
        <translation>Schrittverluste</translation>
    </message>
    <message>
        <source>Permanent jumps by multiples of four full steps, at high load.</source>
        <translation>Bleibende Sprünge um Vielfache von vier Vollschritten, bei hoher Last.</translation>
    </message>
    <message>
        <source>Microstep error</source>
        <translation>Mikroschrittfehler</translation>
    </message>
    <message>
        <source>Periodic in the commanded position, every four full steps; the mechanics filter it.</source>
        <translation>Periodisch in der Sollposition, alle vier Vollschritte; die Mechanik filtert ihn.</translation>
    </message>
    <message>
        <source>Static nonlinearity</source>
        <translation>Statische Nichtlinearität</translation>
    </message>
    <message>
        <source>A curve of the command, without memory, filtered by the mechanics.</source>
        <translation>Eine Kennlinie des Sollwerts, ohne Gedächtnis, von der Mechanik gefiltert.</translation>
    </message>
    <message>
        <source>Backlash</source>
        <translation>Umkehrspiel</translation>
    </message>
    <message>
        <source>Contact</source>
        <translation>Kontakt</translation>
    </message>
    <message>
        <source>Cross coupling</source>
        <translation>Übersprechen</translation>
    </message>
    <message>
        <source>Follows the motion of another axis.</source>
        <translation>Folgt der Bewegung einer anderen Achse.</translation>
    </message>
    <message>
        <source>Flexible mode</source>
        <translation>Elastische Mode</translation>
    </message>
    <message>
        <source>A peak or a dip where the model has none.</source>
        <translation>Eine Spitze oder Senke, wo das Modell keine hat.</translation>
    </message>
    <message>
        <source>Friction</source>
        <translation>Reibung</translation>
    </message>
    <message>
        <source>Spikes at reversals, stick-slip at low speed; damps ringing.</source>
        <translation>Spitzen bei Umkehr, Ruckgleiten bei kleiner Geschwindigkeit; dämpft Nachschwingen.</translation>
    </message>
    <message>
        <source>Lead screw error</source>
        <translation>Spindelfehler</translation>
    </message>
    <message>
        <source>Periodic in position, once per turn: its frequency grows with speed.</source>
        <translation>Periodisch in der Position, einmal je Umdrehung: die Frequenz wächst mit der Geschwindigkeit.</translation>
    </message>
    <message>
        <source>Resonance mismatch</source>
        <translation>Resonanzabweichung</translation>
    </message>
    <message>
        <source>Stiffness nonlinearity</source>
        <translation>Nichtlineare Steifigkeit</translation>
    </message>
    <message>
        <source>Thermal drift</source>
        <translation>Thermische Drift</translation>
    </message>
    <message>
        <source>two bodies</source>
        <translation>zwei Körper</translation>
    </message>
    <message>
        <source>A₂, that of the slower body</source>
        <translation>A₂, die des trägeren Körpers</translation>
    </message>
    <message>
        <source>Vibration</source>
        <translation>Schwingung</translation>
    </message>
    <message>
        <source>Clock skew</source>
        <translation>Taktabweichung</translation>
    </message>
    <message>
        <source>A lag of the reading that grows along the record.</source>
        <translation>Ein Rückstand des Messwerts, der über die Aufzeichnung wächst.</translation>
    </message>
    <message>
        <source>Encoder interpolation error</source>
        <translation>Interpolationsfehler</translation>
    </message>
    <message>
        <source>Sensor drift</source>
        <translation>Sensordrift</translation>
    </message>
    <message>
        <source>Sensor gain error</source>
        <translation>Sensorverstärkungsfehler</translation>
    </message>
    <message>
        <source>The reading is off in proportion to the position; the motion is not.</source>
        <translation>Der Messwert ist proportional zur Position falsch; die Bewegung nicht.</translation>
    </message>
    <message>
        <source>Sensor lag</source>
        <translation>Sensorverzögerung</translation>
    </message>
    <message>
        <source>Phase and gain of the reading fall with frequency; those of the motion do not.</source>
        <translation>Phase und Verstärkung des Messwerts fallen mit der Frequenz; die der Bewegung nicht.</translation>
    </message>
    <message>
        <source>Sensor noise</source>
        <translation>Sensorrauschen</translation>
    </message>
    <message>
        <source>Sensor nonlinearity</source>
        <translation>Sensornichtlinearität</translation>
    </message>
    <message>
        <source>The reading follows a bent curve without memory; the motion does not.</source>
        <translation>Der Messwert folgt einer krummen Kennlinie ohne Gedächtnis; die Bewegung nicht.</translation>
    </message>
    <message>
        <source>Sensor outliers</source>
        <translation>Sensorausreißer</translation>
    </message>
    <message>
        <source>Sensor quantization</source>
        <translation>Sensorquantisierung</translation>
    </message>
    <message>
        <source>Steps of the reading, sharp at any speed: no mechanics filters them.</source>
        <translation>Stufen des Messwerts, scharf bei jeder Geschwindigkeit: keine Mechanik filtert sie.</translation>
    </message>
    <message>
        <source>appendage</source>
        <translation>Anhang</translation>
    </message>
    <message>
        <source>bouc wen</source>
        <translation>Bouc-Wen</translation>
    </message>
    <message>
        <source>bow and cubic</source>
        <translation>Bogen und kubisch</translation>
    </message>
    <message>
        <source>compliant</source>
        <translation>nachgiebig</translation>
    </message>
    <message>
        <source>compliant screw</source>
        <translation>nachgiebige Spindel</translation>
    </message>
    <message>
        <source>constant rate</source>
        <translation>konstante Rate</translation>
    </message>
    <message>
        <source>cubic</source>
        <translation>kubisch</translation>
    </message>
    <message>
        <source>cubic quintic</source>
        <translation>kubisch-quintisch</translation>
    </message>
    <message>
        <source>detuned</source>
        <translation>verstimmt</translation>
    </message>
    <message>
        <source>dropouts held</source>
        <translation>Ausfälle gehalten</translation>
    </message>
    <message>
        <source>dropouts to zero</source>
        <translation>Ausfälle auf null</translation>
    </message>
    <message>
        <source>event</source>
        <translation>Ereignis</translation>
    </message>
    <message>
        <source>exponential</source>
        <translation>exponentiell</translation>
    </message>
    <message>
        <source>first order</source>
        <translation>erster Ordnung</translation>
    </message>
    <message>
        <source>flicker</source>
        <translation>Flicker</translation>
    </message>
    <message>
        <source>hard</source>
        <translation>hart</translation>
    </message>
    <message>
        <source>harmonics</source>
        <translation>Oberwellen</translation>
    </message>
    <message>
        <source>logarithmic</source>
        <translation>logarithmisch</translation>
    </message>
    <message>
        <source>lugre</source>
        <translation>LuGre</translation>
    </message>
    <message>
        <source>mode</source>
        <translation>Mode</translation>
    </message>
    <message>
        <source>modes</source>
        <translation>Moden</translation>
    </message>
    <message>
        <source>modified prandtl ishlinskii</source>
        <translation>modifiziertes Prandtl-Ishlinskii</translation>
    </message>
    <message>
        <source>moving</source>
        <translation>bewegt</translation>
    </message>
    <message>
        <source>overload</source>
        <translation>Überlast</translation>
    </message>
    <message>
        <source>parallel</source>
        <translation>parallel</translation>
    </message>
    <message>
        <source>polynomial</source>
        <translation>Polynom</translation>
    </message>
    <message>
        <source>prandtl ishlinskii</source>
        <translation>Prandtl-Ishlinskii</translation>
    </message>
    <message>
        <source>progressive</source>
        <translation>progressiv</translation>
    </message>
    <message>
        <source>proportional</source>
        <translation>proportional</translation>
    </message>
    <message>
        <source>random walk</source>
        <translation>Zufallsweg</translation>
    </message>
    <message>
        <source>relative</source>
        <translation>relativ</translation>
    </message>
    <message>
        <source>rigid</source>
        <translation>starr</translation>
    </message>
    <message>
        <source>screw</source>
        <translation>Spindel</translation>
    </message>
    <message>
        <source>second order</source>
        <translation>zweiter Ordnung</translation>
    </message>
    <message>
        <source>series</source>
        <translation>Reihe</translation>
    </message>
    <message>
        <source>soft</source>
        <translation>weich</translation>
    </message>
    <message>
        <source>spikes</source>
        <translation>Ausreißer</translation>
    </message>
    <message>
        <source>spring</source>
        <translation>Feder</translation>
    </message>
    <message>
        <source>springs</source>
        <translation>Federn</translation>
    </message>
    <message>
        <source>static</source>
        <translation>statisch</translation>
    </message>
    <message>
        <source>stop</source>
        <translation>Anschlag</translation>
    </message>
    <message>
        <source>stribeck</source>
        <translation>Stribeck</translation>
    </message>
    <message>
        <source>ten plays</source>
        <translation>zehn Spiele</translation>
    </message>
    <message>
        <source>third order</source>
        <translation>dritter Ordnung</translation>
    </message>
    <message>
        <source>tone</source>
        <translation>Ton</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>Transport</translation>
    </message>
    <message>
        <source>two harmonics</source>
        <translation>zwei Oberwellen</translation>
    </message>
    <message>
        <source>two tones</source>
        <translation>zwei Töne</translation>
    </message>
    <message>
        <source>uniform</source>
        <translation>gleichförmig</translation>
    </message>
    <message>
        <source>viscous</source>
        <translation>viskos</translation>
    </message>
    <message>
        <source>warm up</source>
        <translation>Aufwärmen</translation>
    </message>
    <message>
        <source>white</source>
        <translation>weiß</translation>
    </message>
    <message>
        <source>A, mean</source>
        <translation>A, Mittel</translation>
    </message>
    <message>
        <source>L, rms per factor e of frequency</source>
        <translation>L, rms je Faktor e der Frequenz</translation>
    </message>
    <message>
        <source>P, four full steps</source>
        <translation>P, vier Vollschritte</translation>
    </message>
    <message>
        <source>P, one turn or a fraction of it</source>
        <translation>P, eine Umdrehung oder ein Teil davon</translation>
    </message>
    <message>
        <source>S₁, with cosine: offsets of the two signals</source>
        <translation>S₁, mit Kosinus: Versatz der beiden Signale</translation>
    </message>
    <message>
        <source>S₂, with its cosine: unlike gains, phase off 90°</source>
        <translation>S₂, mit seinem Kosinus: ungleiche Verstärkungen, Phase nicht 90°</translation>
    </message>
    <message>
        <source>b at mid-range, as a share of the range</source>
        <translation>b in Bereichsmitte, als Anteil des Bereichs</translation>
    </message>
    <message>
        <source>b, error in mid-range</source>
        <translation>b, Fehler in Bereichsmitte</translation>
    </message>
    <message>
        <source>c₂, twice a period</source>
        <translation>c₂, zweimal je Periode</translation>
    </message>
    <message>
        <source>dry friction</source>
        <translation>trockene Reibung</translation>
    </message>
    <message>
        <source>dry friction backward</source>
        <translation>trockene Reibung rückwärts</translation>
    </message>
    <message>
        <source>dry friction forward</source>
        <translation>trockene Reibung vorwärts</translation>
    </message>
    <message>
        <source>e, relative</source>
        <translation>e, relativ</translation>
    </message>
    <message>
        <source>growth of the slope from end to end</source>
        <translation>Zunahme der Steigung von Ende zu Ende</translation>
    </message>
    <message>
        <source>of the mode</source>
        <translation>der Eigenform</translation>
    </message>
    <message>
        <source>of the play</source>
        <translation>des Spiels</translation>
    </message>
    <message>
        <source>peak of c, as a share of the range</source>
        <translation>Größtwert von c, als Anteil des Bereichs</translation>
    </message>
    <message>
        <source>r, rms after one second</source>
        <translation>r, rms nach einer Sekunde</translation>
    </message>
    <message>
        <source>s₁, counted from mid-range xₘ</source>
        <translation>s₁, gezählt von der Bereichsmitte xₘ</translation>
    </message>
    <message>
        <source>s₂, twice a period</source>
        <translation>s₂, zweimal je Periode</translation>
    </message>
    <message>
        <source>t₁, from the start of the run</source>
        <translation>t₁, ab Beginn</translation>
    </message>
    <message>
        <source>viscous friction</source>
        <translation>viskose Reibung</translation>
    </message>
    <message>
        <source>viscous friction backward</source>
        <translation>viskose Reibung rückwärts</translation>
    </message>
    <message>
        <source>viscous friction forward</source>
        <translation>viskose Reibung vorwärts</translation>
    </message>
    <message>
        <source>β; 1/2: straight line after a reversal</source>
        <translation>β; 1/2: nach einer Umkehr geradlinig</translation>
    </message>
    <message>
        <source>β; negative: met on the way down</source>
        <translation>β; negativ: auf dem Weg abwärts berührt</translation>
    </message>
    <message>
        <source>ε, share of added force at distance L from q₀</source>
        <translation>ε, Anteil der zusätzlichen Kraft im Abstand L von q₀</translation>
    </message>
    <message>
        <source>κ, logarithm of the slopes&apos; ratio</source>
        <translation>κ, Logarithmus des Steigungsverhältnisses</translation>
    </message>
    <message>
        <source>τ; the bandwidth is 1/(2πτ)</source>
        <translation>τ; die Bandbreite ist 1/(2πτ)</translation>
    </message>
    <message>
        <source>Reset {name} to its preset</source>
        <translation>{name} zurück auf die Vorgabe</translation>
    </message>
    <message>
        <source>Reset to the preset, {value}</source>
        <translation>Zurück auf die Vorgabe, {value}</translation>
    </message>
    <message>
        <source>Limits only large, fast motion, which becomes a triangle.</source>
        <translation>Begrenzt nur große, schnelle Bewegung, die zum Dreieck wird.</translation>
    </message>
    <message>
        <source>Motion continues after a move, proportional to it, with the logarithm of time.</source>
        <translation>Die Bewegung geht nach einer Fahrt weiter, proportional zu ihr, mit dem Logarithmus der Zeit.</translation>
    </message>
    <message>
        <source>Loops whose width grows faster than their amplitude, at any speed; odd distortion.</source>
        <translation>Schleifen, deren Breite schneller wächst als ihre Amplitude, bei jeder Geschwindigkeit; ungerade Verzerrung.</translation>
    </message>
    <message>
        <source>A dead band at each reversal, equally wide at any amplitude and speed.</source>
        <translation>Ein Totband bei jeder Umkehr, gleich breit bei jeder Amplitude und Geschwindigkeit.</translation>
    </message>
    <message>
        <source>A stop or a membrane: acts only beyond a position.</source>
        <translation>Ein Anschlag oder eine Membran: wirkt nur jenseits einer Position.</translation>
    </message>
    <message>
        <source>Wrong frequency or damping: visible only near the resonance.</source>
        <translation>Falsche Frequenz oder Dämpfung: nur nahe der Resonanz sichtbar.</translation>
    </message>
    <message>
        <source>A curved static characteristic, and a resonance that shifts with position.</source>
        <translation>Eine gekrümmte statische Kennlinie und eine Resonanz, die mit der Position wandert.</translation>
    </message>
    <message>
        <source>Grows without motion and settles, regardless of the command.</source>
        <translation>Wächst ohne Bewegung und klingt ab, unabhängig vom Sollwert.</translation>
    </message>
    <message>
        <source>Periodic in time, regardless of position and command.</source>
        <translation>Periodisch in der Zeit, unabhängig von Position und Sollwert.</translation>
    </message>
    <message>
        <source>Periodic in position with the period of the grating, only in the reading.</source>
        <translation>Periodisch in der Position mit der Gitterperiode, nur im Messwert.</translation>
    </message>
    <message>
        <source>The reading drifts slowly, also at rest; the reference does not.</source>
        <translation>Der Messwert driftet langsam, auch in Ruhe; die Referenz nicht.</translation>
    </message>
    <message>
        <source>White noise of the reading above the declared level, without memory.</source>
        <translation>Weißes Rauschen des Messwerts über dem angegebenen Pegel, ohne Gedächtnis.</translation>
    </message>
    <message>
        <source>Single wrong samples: spikes or dropouts of the reading.</source>
        <translation>Einzelne falsche Werte: Ausreißer oder Ausfälle des Messwerts.</translation>
    </message>
    <message>
        <source>{text} is not a number; enter one with a decimal point</source>
        <translation>{text} ist keine Zahl; eine mit Dezimalkomma eingeben</translation>
    </message>
    <message>
        <source>{value} must be {range}</source>
        <translation>{value} muss {range} sein</translation>
    </message>
    <message>
        <source>{text} is not a number; enter one in {unit} with a decimal point</source>
        <translation>{text} ist keine Zahl; eine in {unit} mit Dezimalkomma eingeben</translation>
    </message>
    <message>
        <source>Only the simulator has adjustable effects. Connect to the simulator to switch and adjust them.</source>
        <translation>Nur der Simulator hat einstellbare Effekte. Mit dem Simulator verbinden, um sie zu schalten und einzustellen.</translation>
    </message>
    <message>
        <source>Choose an axis, an effect and its formulation</source>
        <translation>Eine Achse, einen Effekt und seinen Ansatz wählen</translation>
    </message>
    <message>
        <source>Simulate the machine of the robot file, or a worn one for demonstration</source>
        <translation>Die Maschine der Roboterdatei simulieren oder eine verschlissene zur Vorführung</translation>
    </message>
    <message>
        <source>Apply this effect earlier within its stage</source>
        <translation>Diesen Effekt innerhalb seiner Stufe früher anwenden</translation>
    </message>
    <message>
        <source>Apply this effect later within its stage</source>
        <translation>Diesen Effekt innerhalb seiner Stufe später anwenden</translation>
    </message>
    <message>
        <source>Remove this effect</source>
        <translation>Diesen Effekt entfernen</translation>
    </message>
    <message>
        <source>Undo the last change of this list</source>
        <translation>Die letzte Änderung dieser Liste zurücknehmen</translation>
    </message>
    <message>
        <source>Compare with the nominal machine: disable all effects until this is released</source>
        <translation>Vergleich mit der nominalen Maschine: alle Effekte aus, bis dies gelöst wird</translation>
    </message>
    <message>
        <source>Replace these effects by those of a robot file</source>
        <translation>Diese Effekte durch die einer Roboterdatei ersetzen</translation>
    </message>
    <message>
        <source>Save a robot file of this robot with these effects</source>
        <translation>Eine Roboterdatei dieses Roboters mit diesen Effekten speichern</translation>
    </message>
    <message>
        <source>From the robot file</source>
        <translation>Laut Roboterdatei</translation>
    </message>
    <message>
        <source>Worn, for demonstration</source>
        <translation>Verschlissen, zur Vorführung</translation>
    </message>
    <message>
        <source>there are no such effects for this robot</source>
        <translation>für diesen Roboter gibt es solche Effekte nicht</translation>
    </message>
    <message>
        <source>{path}: the robot file has no effects; the list is unchanged</source>
        <translation>{path}: die Roboterdatei hat keine Effekte; die Liste bleibt unverändert</translation>
    </message>
    <message>
        <source>the stage has no further effect in this direction</source>
        <translation>in dieser Richtung hat die Stufe keinen weiteren Effekt</translation>
    </message>
    <message>
        <source>the simulator did not accept the change</source>
        <translation>der Simulator hat die Änderung nicht übernommen</translation>
    </message>
    <message>
        <source>Add an effect and adjust it while the simulator runs.</source>
        <translation>Einen Effekt hinzufügen und einstellen, während der Simulator läuft.</translation>
    </message>
    <message>
        <source>Formulation of the effect; its equations appear below</source>
        <translation>Ansatz des Effekts; seine Gleichungen stehen darunter</translation>
    </message>
    <message>
        <source>Axis in which the effect originates</source>
        <translation>Achse, von der der Effekt ausgeht</translation>
    </message>
    <message>
        <source>List of effects</source>
        <translation>Liste der Effekte</translation>
    </message>
    <message>
        <source>Turn the effect on or off</source>
        <translation>Den Effekt ein- oder ausschalten</translation>
    </message>
    <message>
        <source>0: rigid; 1: absorbed from the start</source>
        <translation>0: starr; 1: von Anfang an aufgenommen</translation>
    </message>
    <message>
        <source>1/n; 0: hard</source>
        <translation>1/n; 0: hart</translation>
    </message>
    <message>
        <source>1: equal weights of all plays; more: larger weights of wide plays</source>
        <translation>1: alle Spiele gleich gewichtet; mehr: breite stärker</translation>
    </message>
    <message>
        <source>A, final drift</source>
        <translation>A, Endwert der Drift</translation>
    </message>
    <message>
        <source>Fc/σ₀, deflection of the bristles</source>
        <translation>Fc/σ₀, Auslenkung der Borsten</translation>
    </message>
    <message>
        <source>L, deflection where all springs slip</source>
        <translation>L, Auslenkung, bei der alle gleiten</translation>
    </message>
    <message>
        <source>W, width of a loop that is long compared with ℓ</source>
        <translation>W, Breite einer Schleife, die lang gegen ℓ ist</translation>
    </message>
    <message>
        <source>a, share of the mode&apos;s deflection</source>
        <translation>a, Anteil der Auslenkung der Eigenform</translation>
    </message>
    <message>
        <source>a₁, curvature</source>
        <translation>a₁, Bogen</translation>
    </message>
    <message>
        <source>b, share of the mode&apos;s speed over ω</source>
        <translation>b, Anteil der Geschwindigkeit der Eigenform durch ω</translation>
    </message>
    <message>
        <source>c, maximum of the odd part</source>
        <translation>c, Größtwert des ungeraden Teils</translation>
    </message>
    <message>
        <source>c₁, maximum at the start of the run</source>
        <translation>c₁, am größten zu Beginn</translation>
    </message>
    <message>
        <source>c₂, second harmonic</source>
        <translation>c₂, zweite Oberwelle</translation>
    </message>
    <message>
        <source>damping ratio of the bristles</source>
        <translation>Dämpfungsgrad der Borsten</translation>
    </message>
    <message>
        <source>ratio of dry friction, backward to forward</source>
        <translation>Verhältnis der trockenen Reibung, rückwärts zu vorwärts</translation>
    </message>
    <message>
        <source>e, error of the sensitivity</source>
        <translation>e, Fehler der Empfindlichkeit</translation>
    </message>
    <message>
        <source>distance of the output&apos;s limit from the high end of the input range</source>
        <translation>Abstand der Ausgangsgrenze vom oberen Ende des Eingangsbereichs</translation>
    </message>
    <message>
        <source>distance of the output&apos;s limit from the low end of the input range</source>
        <translation>Abstand der Ausgangsgrenze vom unteren Ende des Eingangsbereichs</translation>
    </message>
    <message>
        <source>rate of occurrence</source>
        <translation>Häufigkeit</translation>
    </message>
    <message>
        <source>ratio of the motion here to the motion there</source>
        <translation>Verhältnis der Bewegung hier zur Bewegung dort</translation>
    </message>
    <message>
        <source>n; an integer on a machine, any number here so that a fit can vary it</source>
        <translation>n; an der Maschine ganz, hier beliebig, damit eine Anpassung es ändern kann</translation>
    </message>
    <message>
        <source>duration of a dropout; 0: one sample</source>
        <translation>Dauer eines Ausfalls; 0: eine Abtastung</translation>
    </message>
    <message>
        <source>ratio of static to dry friction</source>
        <translation>Verhältnis von Haft- zu Gleitreibung</translation>
    </message>
    <message>
        <source>limit of the lag behind the field</source>
        <translation>Grenze des Nachlaufs hinter dem Feld</translation>
    </message>
    <message>
        <source>width of the loop from end to end</source>
        <translation>Breite der Schleife von Ende zu Ende</translation>
    </message>
    <message>
        <source>end of the section</source>
        <translation>Ende des Abschnitts</translation>
    </message>
    <message>
        <source>start of the section, from the low end of the range</source>
        <translation>Anfang des Abschnitts, vom unteren Bereichsende</translation>
    </message>
    <message>
        <source>relative to the axis&apos; own stiffness; negative: met on the way down</source>
        <translation>relativ zur Steifigkeit der Achse; negativ: auf dem Weg abwärts berührt</translation>
    </message>
    <message>
        <source>p, period of the grating</source>
        <translation>p, Periode des Gitters</translation>
    </message>
    <message>
        <source>r, ratio of both time constants</source>
        <translation>r, Verhältnis der Zeitkonstanten</translation>
    </message>
    <message>
        <source>r, share of the motion seen through the link</source>
        <translation>r, Anteil der durch die Kopplung gesehenen Bewegung</translation>
    </message>
    <message>
        <source>r, share of the static motion along this path</source>
        <translation>r, Anteil der statischen Bewegung auf diesem Weg</translation>
    </message>
    <message>
        <source>r, maximum rate; current over capacitance</source>
        <translation>r, größte Rate; Strom durch Kapazität</translation>
    </message>
    <message>
        <source>r; above 0: readings come later</source>
        <translation>r; über 0: Messwerte kommen später</translation>
    </message>
    <message>
        <source>s, 0: all springs slip together</source>
        <translation>s, 0: alle gleiten zugleich</translation>
    </message>
    <message>
        <source>s₁, zero at the start of the run</source>
        <translation>s₁, null zu Beginn</translation>
    </message>
    <message>
        <source>s₂, second harmonic</source>
        <translation>s₂, zweite Oberwelle</translation>
    </message>
    <message>
        <source>t₀, start of the logarithm</source>
        <translation>t₀, Beginn des Logarithmus</translation>
    </message>
    <message>
        <source>position of the contact, from the low end of the range</source>
        <translation>Position des Kontakts, vom unteren Bereichsende</translation>
    </message>
    <message>
        <source>position of the straight part, from mid-range</source>
        <translation>Position des geraden Teils, von der Bereichsmitte</translation>
    </message>
    <message>
        <source>speed where static friction fades</source>
        <translation>Geschwindigkeit, bei der die Haftreibung abklingt</translation>
    </message>
    <message>
        <source>z, position of zero within a step</source>
        <translation>z, Lage der Null in einer Stufe</translation>
    </message>
    <message>
        <source>γ, share of a move per decade of time</source>
        <translation>γ, Anteil einer Bewegung je Dekade der Zeit</translation>
    </message>
    <message>
        <source>δ, error of the natural frequency</source>
        <translation>δ, Fehler der Eigenfrequenz</translation>
    </message>
    <message>
        <source>δ, asymmetry of the way up and the way down</source>
        <translation>δ, Asymmetrie von Hin- und Rückweg</translation>
    </message>
    <message>
        <source>ε, error of the damping ratio</source>
        <translation>ε, Fehler des Dämpfungsgrads</translation>
    </message>
    <message>
        <source>ζ, damping ratio of the contact</source>
        <translation>ζ, Dämpfungsgrad des Kontakts</translation>
    </message>
    <message>
        <source>μ, ratio of its mass to the axis&apos; mass</source>
        <translation>μ, Verhältnis ihrer Masse zu der der Achse</translation>
    </message>
    <message>
        <source>μ, the same for the fifth power</source>
        <translation>μ, dasselbe für die fünfte Potenz</translation>
    </message>
    <message>
        <source>σ, in addition to the declared noise</source>
        <translation>σ, zusätzlich zum angegebenen Rauschen</translation>
    </message>
    <message>
        <source>σ, shift of the grid, in steps</source>
        <translation>σ, Verschiebung des Rasters, in Stufen</translation>
    </message>
    <message>
        <source>τ, for small changes</source>
        <translation>τ, für kleine Änderungen</translation>
    </message>
    <message>
        <source>ℓ, length over which the loop bends</source>
        <translation>ℓ, Länge, über die sich die Schleife biegt</translation>
    </message>
    <message>
        <source>{name}, weight of the play with threshold {threshold}</source>
        <translation>{name}, Gewicht des Spiels mit Schwelle {threshold}</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Effects</source>
        <translation>Effekte</translation>
    </message>
</context>
</TS>
