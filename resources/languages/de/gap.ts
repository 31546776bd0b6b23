<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>gap</name>
    <message>
        <source>Add to twin</source>
        <translation>In den Zwilling übernehmen</translation>
    </message>
    <message>
        <source>Robot files (*.toml)</source>
        <translation>Roboterdateien (*.toml)</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>Save the diagnosis</source>
        <translation>Die Diagnose speichern</translation>
    </message>
    <message>
        <source>JSON (*.json)</source>
        <translation>JSON (*.json)</translation>
    </message>
    <message>
        <source>One record is chosen.</source>
        <translation>Eine Aufzeichnung ist gewählt.</translation>
    </message>
    <message>
        <source>{n} records are chosen.</source>
        <translation>{n} Aufzeichnungen sind gewählt.</translation>
    </message>
    <message>
        <source>This page shows how far the gap shrinks on a motion that the diagnosis has not seen.
Press “New motion …”, or play any trajectory of the diagnosed axes.</source>
        <translation>Diese Seite zeigt, wie weit die Abweichung bei einer Bewegung schrumpft, die die Diagnose nicht gesehen hat.
„Neue Bewegung …“ drücken oder eine Trajektorie der diagnostizierten Achsen abspielen.</translation>
    </message>
    <message>
        <source>Use the model as it is. Effects that these motions do not excite are not ruled out.</source>
        <translation>Das Modell unverändert verwenden. Effekte, die diese Bewegungen nicht anregen, sind nicht ausgeschlossen.</translation>
    </message>
    <message>
        <source>Press “Use corrected model”; then “New motion …” shows how far the gap shrinks.</source>
        <translation>„Korrigiertes Modell verwenden“ drücken; dann zeigt „Neue Bewegung …“, wie weit die Abweichung schrumpft.</translation>
    </message>
    <message>
        <source>Press “Play next experiment …”, or add records of other motions (multisine, staircase, swings), and diagnose them together.</source>
        <translation>„Nächstes Experiment …“ drücken, oder Aufzeichnungen anderer Bewegungen (Multisinus, Treppe, Schwingungen) hinzufügen und zusammen diagnostizieren.</translation>
    </message>
    <message>
        <source>What it means: {meaning}</source>
        <translation>Was es bedeutet: {meaning}</translation>
    </message>
    <message>
        <source>Undecided: {effects} would explain these records equally well. Do not rule any of them out.</source>
        <translation>Nicht entschieden: {effects} würde diese Aufzeichnungen gleich gut erklären. Keinen davon ausschließen.</translation>
    </message>
    <message>
        <source>What to do: {advice}</source>
        <translation>Was zu tun ist: {advice}</translation>
    </message>
    <message>
        <source>Gap: {bars}</source>
        <translation>Abweichung: {bars}</translation>
    </message>
    <message>
        <source>no gap</source>
        <translation>keine Abweichung</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>unbekannt</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>fehlgeschlagen</translation>
    </message>
    <message>
        <source>explained</source>
        <translation>erklärt</translation>
    </message>
    <message>
        <source>Blind test of the diagnosis</source>
        <translation>Blindtest der Diagnose</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Starten</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>%v of %m</source>
        <translation>%v von %m</translation>
    </message>
    <message>
        <source>Figures with their target levels</source>
        <translation>Kennwerte mit ihren Zielwerten</translation>
    </message>
    <message>
        <source>Cases</source>
        <translation>Fälle</translation>
    </message>
    <message>
        <source>Seed</source>
        <translation>Startwert</translation>
    </message>
    <message>
        <source>Figures, each with its 95 % interval</source>
        <translation>Kennwerte, jeder mit seinem 95-%-Intervall</translation>
    </message>
    <message>
        <source>{done} of {count} cases done</source>
        <translation>{done} von {count} Fällen fertig</translation>
    </message>
    <message>
        <source>{done} of {count} cases scored</source>
        <translation>{done} von {count} Fällen bewertet</translation>
    </message>
    <message>
        <source>{truth}, diagnosed as {told}: {share} of its cases</source>
        <translation>{truth}, diagnostiziert als {told}: {share} der Fälle</translation>
    </message>
    <message>
        <source>figure</source>
        <translation>Kennwert</translation>
    </message>
    <message>
        <source>level</source>
        <translation>Soll</translation>
    </message>
    <message>
        <source>reached, 95 %</source>
        <translation>erreicht, 95 %</translation>
    </message>
    <message>
        <source>cases</source>
        <translation>Fälle</translation>
    </message>
    <message>
        <source>The blind test has ended: {reason}</source>
        <translation>Der Blindtest wurde beendet: {reason}</translation>
    </message>
    <message>
        <source>{program}: the blind test cannot be started</source>
        <translation>{program}: der Blindtest lässt sich nicht starten</translation>
    </message>
    <message>
        <source>◂ Map</source>
        <translation>◂ Karte</translation>
    </message>
    <message>
        <source>Back to the map of the gap by band and regime</source>
        <translation>Zurück zur Karte der Abweichung nach Band und Bewegungsart</translation>
    </message>
    <message>
        <source>Record</source>
        <translation>Aufzeichnung</translation>
    </message>
    <message>
        <source>Records by their share of this cell, largest first</source>
        <translation>Aufzeichnungen nach ihrem Anteil an dieser Zelle, der größte zuerst</translation>
    </message>
    <message>
        <source>No record has samples in this cell.</source>
        <translation>Keine Aufzeichnung hat Messwerte in dieser Zelle.</translation>
    </message>
    <message>
        <source>{doing}, about {time:.0f} s left</source>
        <translation>{doing}, noch etwa {time:.0f} s</translation>
    </message>
    <message>
        <source>re-tuned</source>
        <translation>abgestimmt</translation>
    </message>
    <message>
        <source>corrected</source>
        <translation>korrigiert</translation>
    </message>
    <message>
        <source>floor</source>
        <translation>Grenze</translation>
    </message>
    <message>
        <source>black box</source>
        <translation>Black Box</translation>
    </message>
    <message>
        <source>{axis} {tap}, rms on unseen data: closed {share} ({interval})</source>
        <translation>{axis} {tap}, rms auf Prüfdaten: geschlossen {share} ({interval})</translation>
    </message>
    <message>
        <source>{times:.3g} × smaller</source>
        <translation>{times:.3g} × kleiner</translation>
    </message>
    <message>
        <source>{times:.3g} × larger</source>
        <translation>{times:.3g} × größer</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Wo</translation>
    </message>
    <message>
        <source>Which effect</source>
        <translation>Welcher Effekt</translation>
    </message>
    <message>
        <source>How far</source>
        <translation>Wie weit</translation>
    </message>
    <message>
        <source>Unseen motion</source>
        <translation>Ungesehene Bewegung</translation>
    </message>
    <message>
        <source>Axis, channel, frequencies and kind of motion in which the gap lies</source>
        <translation>Achse, Kanal, Frequenzen und Bewegungsart, in denen die Abweichung liegt</translation>
    </message>
    <message>
        <source>New motion</source>
        <translation>Neue Bewegung</translation>
    </message>
    <message>
        <source>How far it shrinks on a motion that the diagnosis has not seen</source>
        <translation>Wie weit sie bei einer Bewegung schrumpft, die die Diagnose nicht gesehen hat</translation>
    </message>
    <message>
        <source>Diagnose</source>
        <translation>Diagnose</translation>
    </message>
    <message>
        <source>Use corrected model</source>
        <translation>Korrigiertes Modell verwenden</translation>
    </message>
    <message>
        <source>Add to twin …</source>
        <translation>Zwilling …</translation>
    </message>
    <message>
        <source>New motion …</source>
        <translation>Neue Bewegung …</translation>
    </message>
    <message>
        <source>Report …</source>
        <translation>Bericht …</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Mehr</translation>
    </message>
    <message>
        <source>Save JSON …</source>
        <translation>JSON speichern …</translation>
    </message>
    <message>
        <source>Blind test …</source>
        <translation>Blindtest …</translation>
    </message>
    <message>
        <source>Hidden machine …</source>
        <translation>Verborgene Maschine …</translation>
    </message>
    <message>
        <source>Reveal</source>
        <translation>Aufdecken</translation>
    </message>
    <message>
        <source>Play next experiment …</source>
        <translation>Nächstes Experiment …</translation>
    </message>
    <message>
        <source>Noise floor {floor}</source>
        <translation>Rauschgrenze {floor}</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>There are no records to diagnose: choose some.</source>
        <translation>Es gibt keine Aufzeichnungen zu diagnostizieren: welche wählen.</translation>
    </message>
    <message>
        <source>choose its model under Model</source>
        <translation>ihr Modell unter Modell wählen</translation>
    </message>
    <message>
        <source>The diagnosis was stopped.</source>
        <translation>Die Diagnose wurde angehalten.</translation>
    </message>
    <message>
        <source>Diagnose …</source>
        <translation>Diagnose …</translation>
    </message>
    <message>
        <source>no effect was found</source>
        <translation>kein Effekt wurde gefunden</translation>
    </message>
    <message>
        <source>the machine is still moving</source>
        <translation>die Maschine bewegt sich noch</translation>
    </message>
    <message>
        <source>Use anyway …</source>
        <translation>Trotzdem verwenden …</translation>
    </message>
    <message>
        <source>{share:.0f} % done</source>
        <translation>{share:.0f} % fertig</translation>
    </message>
    <message>
        <source>Next experiment</source>
        <translation>Nächstes Experiment</translation>
    </message>
    <message>
        <source>Comparing with the twin …</source>
        <translation>Vergleich mit dem Zwilling …</translation>
    </message>
    <message>
        <source>Not played: {why}. Ask for the motion again.</source>
        <translation>Nicht abgespielt: {why}. Die Bewegung noch einmal anfordern.</translation>
    </message>
    <message>
        <source>Play this motion on the machine now?</source>
        <translation>Diese Bewegung jetzt auf der Maschine abspielen?</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>Not now</source>
        <translation>Nicht jetzt</translation>
    </message>
    <message>
        <source>rests at {low} {unit}</source>
        <translation>ruht bei {low} {unit}</translation>
    </message>
    <message>
        <source>record</source>
        <translation>Aufzeichnung</translation>
    </message>
    <message>
        <source>nominal</source>
        <translation>nominal</translation>
    </message>
    <message>
        <source>unseen motion</source>
        <translation>ungesehene Bewegung</translation>
    </message>
    <message>
        <source>worse: {change}</source>
        <translation>schlechter: {change}</translation>
    </message>
    <message>
        <source>better: {change}</source>
        <translation>besser: {change}</translation>
    </message>
    <message>
        <source>about the same</source>
        <translation>etwa gleich</translation>
    </message>
    <message>
        <source>How far the gap shrinks on the new motion</source>
        <translation>Wie weit die Abweichung bei der neuen Bewegung schrumpft</translation>
    </message>
    <message>
        <source>{axis}: 1 candidate tried</source>
        <translation>{axis}: 1 Kandidat geprüft</translation>
    </message>
    <message>
        <source>{axis}: {n} candidates tried</source>
        <translation>{axis}: {n} Kandidaten geprüft</translation>
    </message>
    <message>
        <source>Model re-tuned</source>
        <translation>Modell abgestimmt</translation>
    </message>
    <message>
        <source>{effect} from {axis}</source>
        <translation>{effect} von {axis}</translation>
    </message>
    <message>
        <source>Records (*.csv *.txt *.dat *.gz);;All files (*)</source>
        <translation>Aufzeichnungen (*.csv *.txt *.dat *.gz);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>{n} records</source>
        <translation>{n} Aufzeichn.</translation>
    </message>
    <message>
        <source>1 record</source>
        <translation>1 Aufzeichn.</translation>
    </message>
    <message>
        <source>Records …</source>
        <translation>Aufzeichn. …</translation>
    </message>
    <message>
        <source>Choose the records of the real machine</source>
        <translation>Die Aufzeichnungen der echten Maschine wählen</translation>
    </message>
    <message>
        <source>Add records …</source>
        <translation>Aufzeichnungen hinzufügen …</translation>
    </message>
    <message>
        <source>Records</source>
        <translation>Aufzeichnungen</translation>
    </message>
    <message>
        <source>gap</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>Add files …</source>
        <translation>Dateien hinzufügen …</translation>
    </message>
    <message>
        <source>Records of the real machine</source>
        <translation>Aufzeichnungen der echten Maschine</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>{robot}, nominal</source>
        <translation>{robot}, nominal</translation>
    </message>
    <message>
        <source>Robot file …</source>
        <translation>Roboterdatei …</translation>
    </message>
    <message>
        <source>Robot file</source>
        <translation>Roboterdatei</translation>
    </message>
    <message>
        <source>Drawing the result.</source>
        <translation>Das Ergebnis wird gezeichnet.</translation>
    </message>
    <message>
        <source>Axis {axis}.</source>
        <translation>Achse {axis}.</translation>
    </message>
    <message>
        <source>Record and channel</source>
        <translation>Aufzeichnung und Kanal</translation>
    </message>
    <message>
        <source>gap [{unit}]: &lt;span style=&quot;color:{command}&quot;&gt;before&lt;/span&gt;, &lt;span style=&quot;color:{good}&quot;&gt;noise floor&lt;/span&gt;</source>
        <translation>Abweichung [{unit}]: &lt;span style=&quot;color:{command}&quot;&gt;vorher&lt;/span&gt;, &lt;span style=&quot;color:{good}&quot;&gt;Rauschgrenze&lt;/span&gt;</translation>
    </message>
    <message>
        <source>gap [{unit}]: &lt;span style=&quot;color:{command}&quot;&gt;before&lt;/span&gt;, &lt;span style=&quot;color:{model}&quot;&gt;after&lt;/span&gt;, &lt;span style=&quot;color:{good}&quot;&gt;noise floor&lt;/span&gt;</source>
        <translation>Abweichung [{unit}]: &lt;span style=&quot;color:{command}&quot;&gt;vorher&lt;/span&gt;, &lt;span style=&quot;color:{model}&quot;&gt;nachher&lt;/span&gt;, &lt;span style=&quot;color:{good}&quot;&gt;Rauschgrenze&lt;/span&gt;</translation>
    </message>
    <message>
        <source>share</source>
        <translation>Anteil</translation>
    </message>
    <message>
        <source>gap rms</source>
        <translation>Abweichung rms</translation>
    </message>
    <message>
        <source>worst at</source>
        <translation>am größten bei</translation>
    </message>
    <message>
        <source>motion</source>
        <translation>Bewegungsart</translation>
    </message>
    <message>
        <source>Share of the gap above the noise floors of all axes and channels</source>
        <translation>Anteil an der Abweichung über den Rauschgrenzen aller Achsen und Kanäle</translation>
    </message>
    <message>
        <source>Measured minus model, mean removed</source>
        <translation>Gemessen minus Modell, ohne Mittelwert</translation>
    </message>
    <message>
        <source>95 % interval of the share</source>
        <translation>95-%-Intervall des Anteils</translation>
    </message>
    <message>
        <source>Where the gap lies</source>
        <translation>Wo die Abweichung liegt</translation>
    </message>
    <message>
        <source>Gap by band and regime</source>
        <translation>Abweichung nach Band und Bewegungsart</translation>
    </message>
    <message>
        <source>{axis} {tap}, {regime}, {low:g} to {high:g} Hz</source>
        <translation>{axis} {tap}, {regime}, {low:g} bis {high:g} Hz</translation>
    </message>
    <message>
        <source>{place}: gap rms [noise floors] by motion and frequency band; the headings are the lower ends of the bands in Hz. Click a cell to see its traces.</source>
        <translation>{place}: Abweichung rms [Rauschgrenzen] nach Bewegungsart und Frequenzband; die Überschriften nennen die unteren Bandgrenzen in Hz. Eine Zelle anklicken, um die Verläufe zu sehen.</translation>
    </message>
    <message>
        <source>{low} to {high} Hz</source>
        <translation>{low} bis {high} Hz</translation>
    </message>
    <message>
        <source>{regime}, {low} to {high} Hz: {floors} noise floors rms</source>
        <translation>{regime}, {low} bis {high} Hz: {floors} Rauschgrenzen rms</translation>
    </message>
    <message>
        <source>Click to see the traces</source>
        <translation>Klicken, um die Verläufe zu sehen</translation>
    </message>
    <message>
        <source>noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>candidate</source>
        <translation>Kandidat</translation>
    </message>
    <message>
        <source>probability</source>
        <translation>Wahrscheinl.</translation>
    </message>
    <message>
        <source>remainder (noise floors)</source>
        <translation>Rest (Rauschgrenzen)</translation>
    </message>
    <message>
        <source>95 % interval of the remainder, in noise floors</source>
        <translation>95-%-Intervall des Rests, in Rauschgrenzen</translation>
    </message>
    <message>
        <source>Candidates, most likely first</source>
        <translation>Kandidaten, der wahrscheinlichste zuerst</translation>
    </message>
    <message>
        <source>Next experiment: {why}</source>
        <translation>Nächstes Experiment: {why}</translation>
    </message>
    <message>
        <source>{effect}: {share} likely; {before} rms without it, {after} with it at {tap}, on unseen data; closes {closed} ({interval}).</source>
        <translation>{effect}: zu {share} wahrscheinlich; {before} rms ohne, {after} damit bei {tap}, auf Prüfdaten; schließt {closed} ({interval}).</translation>
    </message>
    <message>
        <source>{parameter}, at its low bound</source>
        <translation>{parameter}, an der unteren Grenze</translation>
    </message>
    <message>
        <source>{parameter}, at its high bound</source>
        <translation>{parameter}, an der oberen Grenze</translation>
    </message>
    <message>
        <source>Unknown effect</source>
        <translation>Unbekannter Effekt</translation>
    </message>
    <message>
        <source>No gap: model and machine differ by no more than noise</source>
        <translation>Keine Abweichung: Modell und Maschine unterscheiden sich nur um Rauschen</translation>
    </message>
    <message>
        <source>Explained: the effects below account for the gap</source>
        <translation>Erklärt: die Effekte unten erklären die Abweichung</translation>
    </message>
    <message>
        <source>Not examined, because the program failed</source>
        <translation>Nicht untersucht, weil das Programm versagt hat</translation>
    </message>
    <message>
        <source>No gap of its own</source>
        <translation>Keine eigene Abweichung</translation>
    </message>
    <message>
        <source>Explained</source>
        <translation>Erklärt</translation>
    </message>
    <message>
        <source>rest</source>
        <translation>Ruhe</translation>
    </message>
    <message>
        <source>settling</source>
        <translation>Einschwingen</translation>
    </message>
    <message>
        <source>reversal</source>
        <translation>Umkehr</translation>
    </message>
    <message>
        <source>forward</source>
        <translation>vorwärts</translation>
    </message>
    <message>
        <source>backward</source>
        <translation>rückwärts</translation>
    </message>
    <message>
        <source>fast</source>
        <translation>schnell</translation>
    </message>
    <message>
        <source>slow</source>
        <translation>langsam</translation>
    </message>
    <message>
        <source>other axis moving</source>
        <translation>andere Achse bewegt</translation>
    </message>
    <message>
        <source>large swing</source>
        <translation>große Amplitude</translation>
    </message>
    <message>
        <source>small swing</source>
        <translation>kleine Amplitude</translation>
    </message>
    <message>
        <source>low end of travel</source>
        <translation>unteres Ende des Bereichs</translation>
    </message>
    <message>
        <source>middle of travel</source>
        <translation>Mitte des Bereichs</translation>
    </message>
    <message>
        <source>high end of travel</source>
        <translation>oberes Ende des Bereichs</translation>
    </message>
    <message>
        <source>first quarter of a turn</source>
        <translation>1. Viertelumdrehung</translation>
    </message>
    <message>
        <source>second quarter of a turn</source>
        <translation>2. Viertelumdrehung</translation>
    </message>
    <message>
        <source>third quarter of a turn</source>
        <translation>3. Viertelumdrehung</translation>
    </message>
    <message>
        <source>last quarter of a turn</source>
        <translation>4. Viertelumdrehung</translation>
    </message>
    <message>
        <source>reading</source>
        <translation>Lesen</translation>
    </message>
    <message>
        <source>where</source>
        <translation>Ort der Abweichung</translation>
    </message>
    <message>
        <source>screening</source>
        <translation>Vorauswahl</translation>
    </message>
    <message>
        <source>fitting</source>
        <translation>Anpassung</translation>
    </message>
    <message>
        <source>deciding</source>
        <translation>Entscheidung</translation>
    </message>
    <message>
        <source>drawing</source>
        <translation>Zeichnen</translation>
    </message>
    <message>
        <source>… where the gap is ≥ 5 floors</source>
        <translation>… wo die Abweichung ≥ 5 Grenzen ist</translation>
    </message>
    <message>
        <source>… where it is smaller</source>
        <translation>… wo sie kleiner ist</translation>
    </message>
    <message>
        <source>truth in the reported set</source>
        <translation>Wahrheit in der genannten Menge</translation>
    </message>
    <message>
        <source>mean size of the set</source>
        <translation>mittlere Größe der Menge</translation>
    </message>
    <message>
        <source>gap closed on unseen data, median</source>
        <translation>Abweichung geschlossen auf Prüfdaten, Median</translation>
    </message>
    <message>
        <source>gap closed, 10th percentile</source>
        <translation>Abweichung geschlossen, 10. Perzentil</translation>
    </message>
    <message>
        <source>expected calibration error</source>
        <translation>erwarteter Kalibrierfehler</translation>
    </message>
    <message>
        <source>or</source>
        <translation>oder</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>the records contain no axis of the robot</source>
        <translation>die Aufzeichnungen enthalten keine Achse des Roboters</translation>
    </message>
    <message>
        <source>It is coupled to axis {axis}, whose gap is larger and not explained.</source>
        <translation>Sie ist mit Achse {axis} gekoppelt, deren Abweichung größer und nicht erklärt ist.</translation>
    </message>
    <message>
        <source>The program failed to examine this axis, which says nothing about the machine: {error}.</source>
        <translation>Das Programm konnte diese Achse nicht untersuchen; das sagt nichts über die Maschine: {error}.</translation>
    </message>
    <message>
        <source>{group} ({percent})</source>
        <translation>{group} ({percent})</translation>
    </message>
    <message>
        <source>Judging by simple features, the rest depends on {groups}.</source>
        <translation>Nach einfachen Merkmalen hängt der Rest ab von {groups}.</translation>
    </message>
    <message>
        <source>{n} spikes or dropouts of the sensor were left out.</source>
        <translation>{n} Ausreißer oder Ausfälle des Sensors wurden ausgelassen.</translation>
    </message>
    <message>
        <source>The sensor reads in steps of {step}.</source>
        <translation>Der Sensor liest in Stufen von {step}.</translation>
    </message>
    <message>
        <source>The sensor is {times} times as noisy as declared.</source>
        <translation>Der Sensor rauscht {times}-mal so stark wie angegeben.</translation>
    </message>
    <message>
        <source>no record was given; name at least one</source>
        <translation>keine Aufzeichnung angegeben; mindestens eine angeben</translation>
    </message>
    <message>
        <source>{listed}: no measured channel (u, ref or meas) but only commands; give records of the real machine</source>
        <translation>{listed}: kein gemessener Kanal (u, ref oder meas), nur Sollwerte; Aufzeichnungen der echten Maschine angeben</translation>
    </message>
    <message>
        <source>{name}: axis {axis} is in units of {units}, but robot {robot_name} moves it in units of {unit}; correct the unit</source>
        <translation>{name}: Achse {axis} steht in Einheiten von {units}, Roboter {robot_name} bewegt sie in Einheiten von {unit}; die Einheit berichtigen</translation>
    </message>
    <message>
        <source>{name}: axis {quoted} has no {axis}.cmd column to drive the model; add it</source>
        <translation>{name}: Achse {quoted} hat keine Spalte {axis}.cmd, die das Modell treibt; hinzufügen</translation>
    </message>
    <message>
        <source>{name}: {count} rows; a diagnosis needs {least_rows} rows or more in each record: leave it out, or record longer</source>
        <translation>{name}: {count} Zeilen; eine Diagnose braucht mindestens {least_rows} Zeilen je Aufzeichnung: weglassen oder länger aufzeichnen</translation>
    </message>
    <message>
        <source>{low} to {high}</source>
        <translation>{low} bis {high}</translation>
    </message>
    <message>
        <source>{name}: {axis}.cmd = {command} at row {row} is far outside the range {bounds} of robot {robot_name}: this looks like a unit error; correct the unit in the header, or the robot file</source>
        <translation>{name}: {axis}.cmd = {command} in Zeile {row} liegt weit außerhalb des Bereichs {bounds} von Roboter {robot_name}: das sieht nach einem Einheitenfehler aus; die Einheit in der Kopfzeile oder die Roboterdatei berichtigen</translation>
    </message>
    <message>
        <source>{name}: axis {axis} is commanded at {speed} {unit}/s, {times} × its speed limit: this looks like a unit error of time; correct the unit of t, such as ms for s</source>
        <translation>{name}: Achse {axis} wird mit {speed} {unit}/s bewegt, dem {times}-Fachen ihrer Grenzgeschwindigkeit: das sieht nach einem Einheitenfehler der Zeit aus; die Einheit von t berichtigen, etwa ms statt s</translation>
    </message>
    <message>
        <source>{name}: {axis}.u is {gain} × cmd/gain, the output of the amplifier: this looks like a unit error, or a voltage before the amplifier; correct the column, leave it out, or correct the gain in the robot file</source>
        <translation>{name}: {axis}.u ist das {gain}-Fache von cmd/gain, der Ausgabe des Verstärkers: das sieht nach einem Einheitenfehler oder einer Spannung vor dem Verstärker aus; die Spalte berichtigen, weglassen oder gain in der Roboterdatei berichtigen</translation>
    </message>
    <message>
        <source>{factor}, such as {wrong} read as {right}</source>
        <translation>{factor}, etwa {wrong} gelesen als {right}</translation>
    </message>
    <message>
        <source>, which may be too little</source>
        <translation>, was zu wenig sein kann</translation>
    </message>
    <message>
        <source>{name}: {axis}.meas stays at exactly {stand} for {percent} % of the rows, while the axis is commanded to move (first at t = {time_s} s): the sensor is {what}; repair it, stay within its measuring range, or leave the column out</source>
        <translation>{name}: {axis}.meas steht in {percent} % der Zeilen bei genau {stand}, während die Achse sich bewegen soll (zuerst bei t = {time_s} s): der Sensor ist {what}; ihn reparieren, in seinem Messbereich bleiben oder die Spalte weglassen</translation>
    </message>
    <message>
        <source>stuck or not connected</source>
        <translation>hängengeblieben oder nicht verbunden</translation>
    </message>
    <message>
        <source>saturated</source>
        <translation>in Sättigung</translation>
    </message>
    <message>
        <source>To distinguish {effects}, play this: {test}; it separates them{closest} by {n} noise floors (rms), even after each is fitted to it{doubt}{limits}{reference}{others}.</source>
        <translation>Um {effects} zu trennen, dies abspielen: {test}; es bringt sie{closest} {n} Rauschgrenzen (rms) auseinander, auch wenn jeder daran angepasst ist{doubt}{limits}{reference}{others}.</translation>
    </message>
    <message>
        <source>, the closest two of them,</source>
        <translation>, die zwei ähnlichsten,</translation>
    </message>
    <message>
        <source>: it is no faster than the records, because the robot file states no max_speed and max_acceleration for {axis}</source>
        <translation>: es ist nicht schneller als die Aufzeichnungen, weil die Roboterdatei für {axis} weder max_speed noch max_acceleration nennt</translation>
    </message>
    <message>
        <source>{name}, ±{size} about {middle}, {time} s</source>
        <translation>{name}, ±{size} um {middle}, {time} s</translation>
    </message>
    <message>
        <source>{name} of {moved} while {held} is held</source>
        <translation>{name} von {moved}, während {held} gehalten wird</translation>
    </message>
    <message>
        <source>fast {size}triangle</source>
        <translation>schnelles {size}Dreieck</translation>
    </message>
    <message>
        <source>slow {size}triangle</source>
        <translation>langsames {size}Dreieck</translation>
    </message>
    <message>
        <source>fast {hz} Hz sine</source>
        <translation>schneller {hz}-Hz-Sinus</translation>
    </message>
    <message>
        <source>{hz} Hz sine</source>
        <translation>{hz}-Hz-Sinus</translation>
    </message>
    <message>
        <source>decaying triangle</source>
        <translation>abklingendes Dreieck</translation>
    </message>
    <message>
        <source>staircase</source>
        <translation>Treppe</translation>
    </message>
    <message>
        <source>steps with long holds</source>
        <translation>Sprünge mit langem Halten</translation>
    </message>
    <message>
        <source>ramps at two constant speeds</source>
        <translation>Rampen mit zwei konstanten Geschwindigkeiten</translation>
    </message>
    <message>
        <source>multisine</source>
        <translation>Multisinus</translation>
    </message>
    <message>
        <source>chirp</source>
        <translation>Chirp</translation>
    </message>
    <message>
        <source>small </source>
        <translation>kleines </translation>
    </message>
    <message>
        <source>large </source>
        <translation>großes </translation>
    </message>
    <message>
        <source>very likely</source>
        <translation>sehr wahrscheinlich</translation>
    </message>
    <message>
        <source>likely</source>
        <translation>wahrscheinlich</translation>
    </message>
    <message>
        <source>possible</source>
        <translation>möglich</translation>
    </message>
    <message>
        <source>gap, rms [{unit}]</source>
        <translation>Abweichung, rms [{unit}]</translation>
    </message>
    <message>
        <source>Waterfall of the gap: {bars}</source>
        <translation>Wasserfall der Abweichung: {bars}</translation>
    </message>
    <message>
        <source>remainder on unseen data, rms [noise floors]; with probability</source>
        <translation>Rest auf Prüfdaten, rms [Rauschgrenzen]; mit Wahrscheinlichkeit</translation>
    </message>
    <message>
        <source>Candidates, most likely first: {names}</source>
        <translation>Kandidaten, der wahrscheinlichste zuerst: {names}</translation>
    </message>
    <message>
        <source>command</source>
        <translation>Sollwert</translation>
    </message>
    <message>
        <source>minus that of
{effect} [{unit}]</source>
        <translation>abzüglich der von
{effect} [{unit}]</translation>
    </message>
    <message>
        <source>Predictions of {rivals} for the suggested experiment</source>
        <translation>Vorhersagen von {rivals} für das vorgeschlagene Experiment</translation>
    </message>
    <message>
        <source>direction</source>
        <translation>Richtung</translation>
    </message>
    <message>
        <source>speed</source>
        <translation>Geschwindigkeit</translation>
    </message>
    <message>
        <source>past commands</source>
        <translation>früheren Sollwerten</translation>
    </message>
    <message>
        <source>time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>position phase</source>
        <translation>Positionsphase</translation>
    </message>
    <message>
        <source>axis {axis}</source>
        <translation>Achse {axis}</translation>
    </message>
    <message>
        <source>No gap of its own on {axes}.</source>
        <translation>Keine eigene Abweichung: {axes}.</translation>
    </message>
    <message>
        <source>{axis}: not examined, because the program failed.</source>
        <translation>{axis}: nicht untersucht, weil das Programm versagt hat.</translation>
    </message>
    <message>
        <source>{axis}: a gap that no known effect explains.</source>
        <translation>{axis}: eine Abweichung, die kein bekannter Effekt erklärt.</translation>
    </message>
    <message>
        <source>{axis}: {cause}, {likelihood}.</source>
        <translation>{axis}: {cause}, {likelihood}.</translation>
    </message>
    <message>
        <source>{axis}: {causes}.</source>
        <translation>{axis}: {causes}.</translation>
    </message>
    <message>
        <source>{cause} ({likelihood})</source>
        <translation>{cause} ({likelihood})</translation>
    </message>
    <message>
        <source>{gap} is {raw} rms (noise floor {floor}).</source>
        <translation>{gap} beträgt {raw} rms (Rauschgrenze {floor}).</translation>
    </message>
    <message>
        <source>Adding it to the model takes {gap} from {raw} to {corrected} rms on unseen data (noise floor {floor}).</source>
        <translation>Im Modell ergänzt, bringt das {gap} auf Prüfdaten von {raw} auf {corrected} rms (Rauschgrenze {floor}).</translation>
    </message>
    <message>
        <source>Adding them to the model takes {gap} from {raw} to {corrected} rms on unseen data (noise floor {floor}).</source>
        <translation>Im Modell ergänzt, bringen sie {gap} auf Prüfdaten von {raw} auf {corrected} rms (Rauschgrenze {floor}).</translation>
    </message>
    <message>
        <source>The gap</source>
        <translation>Die Abweichung</translation>
    </message>
    <message>
        <source>the gap</source>
        <translation>die Abweichung</translation>
    </message>
    <message>
        <source>The gap at {tap}</source>
        <translation>Die Abweichung bei {tap}</translation>
    </message>
    <message>
        <source>the gap at {tap}</source>
        <translation>die Abweichung bei {tap}</translation>
    </message>
    <message>
        <source>Worse on {motion}: {axes}.   </source>
        <translation>Schlechter bei {motion}: {axes}.   </translation>
    </message>
    <message>
        <source>Use this model for predictions anyway?</source>
        <translation>Dieses Modell trotzdem für Vorhersagen verwenden?</translation>
    </message>
    <message>
        <source>Use anyway</source>
        <translation>Trotzdem verwenden</translation>
    </message>
    <message>
        <source>Choosing a machine at random …</source>
        <translation>Eine Maschine wird ausgelost …</translation>
    </message>
    <message>
        <source>Hidden machine</source>
        <translation>Verborgene Maschine</translation>
    </message>
    <message>
        <source>The diagnosis names: {causes}</source>
        <translation>Die Diagnose nennt: {causes}</translation>
    </message>
    <message>
        <source>Score: {right} of {played}</source>
        <translation>Stand: {right} von {played}</translation>
    </message>
    <message>
        <source>nothing</source>
        <translation>nichts</translation>
    </message>
    <message>
        <source>{name}, rows {first} to {last}</source>
        <translation>{name}, Zeilen {first} bis {last}</translation>
    </message>
    <message>
        <source>record {number} ({rows} rows, {duration} s)</source>
        <translation>Aufzeichnung {number} ({rows} Zeilen, {duration} s)</translation>
    </message>
    <message>
        <source>{name}: time jumps {count} ×, by up to {longest_s} s, and no piece between has more than {max} rows; a diagnosis needs {least_rows} or more without a jump: leave the record out, or record without losses</source>
        <translation>{name}: die Zeit springt {count}-mal, um bis zu {longest_s} s, und kein Stück dazwischen hat mehr als {max} Zeilen; eine Diagnose braucht mindestens {least_rows} ohne Sprung: die Aufzeichnung weglassen oder ohne Verluste aufzeichnen</translation>
    </message>
    <message>
        <source>axis {axis}: no record holds a measured channel of it (u, ref or meas) whose noise floor is known or can be measured; nothing can be compared</source>
        <translation>Achse {axis}: keine Aufzeichnung enthält einen gemessenen Kanal (u, ref oder meas) mit bekannter oder messbarer Rauschgrenze; es gibt nichts zu vergleichen</translation>
    </message>
    <message>
        <source>en</source>
        <translation>de</translation>
    </message>
    <message>
        <source>Gap diagnosis of {robot}</source>
        <translation>Diagnose der Abweichung von {robot}</translation>
    </message>
    <message>
        <source>Gap between model and machine: {robot}</source>
        <translation>Abweichung zwischen Modell und Maschine: {robot}</translation>
    </message>
    <message>
        <source>How far it shrinks</source>
        <translation>Wie weit sie schrumpft</translation>
    </message>
    <message>
        <source>Parameters</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Remarks</source>
        <translation>Bemerkungen</translation>
    </message>
    <message>
        <source>Facts</source>
        <translation>Angaben</translation>
    </message>
    <message>
        <source>axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>channel</source>
        <translation>Kanal</translation>
    </message>
    <message>
        <source>stage</source>
        <translation>Stufe</translation>
    </message>
    <message>
        <source>gap, rms</source>
        <translation>Abweichung, rms</translation>
    </message>
    <message>
        <source>noise floor</source>
        <translation>Rauschgrenze</translation>
    </message>
    <message>
        <source>its interval</source>
        <translation>Intervall dazu</translation>
    </message>
    <message>
        <source>(gap² − floor²)/floor²</source>
        <translation>(Abweichung² − Rauschgrenze²)/Rauschgrenze²</translation>
    </message>
    <message>
        <source>worst band</source>
        <translation>schlechtestes Band</translation>
    </message>
    <message>
        <source>worst regime</source>
        <translation>schlechteste Bewegungsart</translation>
    </message>
    <message>
        <source>Axes and channels whose gap certainly exceeds the noise floor. Shares are of the squared gap above the floors; intervals are 95 % intervals.</source>
        <translation>Achsen und Kanäle, deren Abweichung sicher über der Rauschgrenze liegt. Anteile beziehen sich auf das Quadrat der Abweichung oberhalb der Rauschgrenzen; Intervalle sind 95-%-Intervalle.</translation>
    </message>
    <message>
        <source>No axis has a gap that certainly exceeds the noise floor.</source>
        <translation>Keine Achse hat eine Abweichung, die sicher über der Rauschgrenze liegt.</translation>
    </message>
    <message>
        <source>{axis} at {tap}, by band and regime</source>
        <translation>{axis} an {tap}, nach Band und Bewegungsart</translation>
    </message>
    <message>
        <source>regime</source>
        <translation>Bewegungsart</translation>
    </message>
    <message>
        <source>Rms of the model&apos;s gap within each band, in noise floors. Regimes overlap: forward motion is also fast or slow.</source>
        <translation>Effektivwert der Modellabweichung im jeweiligen Band, in Rauschgrenzen. Bewegungsarten überschneiden sich: eine Vorwärtsbewegung ist auch schnell oder langsam.</translation>
    </message>
    <message>
        <source>Which effect causes it</source>
        <translation>Welcher Effekt sie verursacht</translation>
    </message>
    <message>
        <source>effect</source>
        <translation>Effekt</translation>
    </message>
    <message>
        <source>formulation</source>
        <translation>Formulierung</translation>
    </message>
    <message>
        <source>indistinguishable from</source>
        <translation>nicht unterscheidbar von</translation>
    </message>
    <message>
        <source>gap without it</source>
        <translation>Abweichung ohne ihn</translation>
    </message>
    <message>
        <source>with it</source>
        <translation>mit ihm</translation>
    </message>
    <message>
        <source>closed</source>
        <translation>geschlossen</translation>
    </message>
    <message>
        <source>Gaps are rms on data that the fit did not see; all other causes are in the model.</source>
        <translation>Abweichungen sind Effektivwerte auf Daten, die die Anpassung nicht sah; alle anderen Ursachen sind im Modell.</translation>
    </message>
    <message>
        <source>No effect is named.</source>
        <translation>Kein Effekt wird genannt.</translation>
    </message>
    <message>
        <source>Candidates for {axis}</source>
        <translation>Kandidaten für {axis}</translation>
    </message>
    <message>
        <source>remainder on unseen data [noise floors]</source>
        <translation>Rest auf Prüfdaten [Rauschgrenzen]</translation>
    </message>
    <message>
        <source>How far the gap shrinks</source>
        <translation>Wie weit die Abweichung schrumpft</translation>
    </message>
    <message>
        <source>{axis} at {tap}</source>
        <translation>{axis} an {tap}</translation>
    </message>
    <message>
        <source>Rms of the gap on data that no fit saw: with the model as it is, with its own parameters re-tuned, and with one effect after another.</source>
        <translation>Effektivwert der Abweichung auf Daten, die keine Anpassung sah: mit dem Modell, wie es ist, mit neu abgestimmten eigenen Parametern und mit einem Effekt nach dem anderen.</translation>
    </message>
    <message>
        <source>raw</source>
        <translation>roh</translation>
    </message>
    <message>
        <source>black-box model</source>
        <translation>Black-Box-Modell</translation>
    </message>
    <message>
        <source>with</source>
        <translation>mit</translation>
    </message>
    <message>
        <source>on</source>
        <translation>an</translation>
    </message>
    <message>
        <source>remainder, rms</source>
        <translation>Rest, rms</translation>
    </message>
    <message>
        <source>share of the closed gap (Shapley)</source>
        <translation>Anteil an der geschlossenen Abweichung (Shapley)</translation>
    </message>
    <message>
        <source>Left: the gap before (grey) and after (blue) over time; the band is the noise floor. Middle: reading over command, real and models. Right: the gap over the command. Each model is shifted to the mean of its record: constant offsets are not judged.</source>
        <translation>Links: die Abweichung vorher (grau) und nachher (blau) über der Zeit; das Band ist die Rauschgrenze. Mitte: Messwert über dem Sollwert, real und Modelle. Rechts: die Abweichung über dem Sollwert. Jedes Modell ist auf den Mittelwert seiner Aufzeichnung verschoben: konstante Versätze werden nicht beurteilt.</translation>
    </message>
    <message>
        <source>From command to {tap} by Welch&apos;s method (H1), where the response is coherent; the band is the 95 % interval of the real one.</source>
        <translation>Vom Sollwert zu {tap} nach Welch (H1), wo die Antwort kohärent ist; das Band ist das 95-%-Intervall der Maschine.</translation>
    </message>
    <message>
        <source>parameter</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>If a parameter is at a bound, the equations fit only in part. Where no interval is given, the data do not bound the value.</source>
        <translation>Liegt ein Parameter an einer Grenze, passen die Gleichungen nur zum Teil. Wo kein Intervall steht, begrenzen die Daten den Wert nicht.</translation>
    </message>
    <message>
        <source>No effect was fitted.</source>
        <translation>Es wurde kein Effekt angepasst.</translation>
    </message>
    <message>
        <source>Effects of the corrected model</source>
        <translation>Effekte des korrigierten Modells</translation>
    </message>
    <message>
        <source>95 % interval</source>
        <translation>95-%-Intervall</translation>
    </message>
    <message>
        <source>SI</source>
        <translation>SI</translation>
    </message>
    <message>
        <source>at a bound</source>
        <translation>an einer Grenze</translation>
    </message>
    <message>
        <source>parameters, SI</source>
        <translation>Parameter, SI</translation>
    </message>
    <message>
        <source>None.</source>
        <translation>Keine.</translation>
    </message>
    <message>
        <source>The reading as each rival, fitted to these records, predicts it.</source>
        <translation>Der Messwert, wie ihn jeder Kandidat vorhersagt, angepasst an diese Aufzeichnungen.</translation>
    </message>
    <message>
        <source>{tap} as each rival, fitted to these records, predicts it.</source>
        <translation>{tap}, wie es jeder Kandidat vorhersagt, angepasst an diese Aufzeichnungen.</translation>
    </message>
    <message>
        <source>No experiment is needed, or none was found that would give more information.</source>
        <translation>Kein Experiment ist nötig, oder es wurde keines gefunden, das mehr Aufschluss gäbe.</translation>
    </message>
    <message>
        <source>Robot {robot}; axes</source>
        <translation>Roboter {robot}; Achsen</translation>
    </message>
    <message>
        <source>Effects in the model before: {count}. Seed {seed}; RoTeMiNa {version}.</source>
        <translation>Effekte, die schon im Modell waren: {count}. Startwert {seed}; RoTeMiNa {version}.</translation>
    </message>
    <message>
        <source>name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>rows</source>
        <translation>Zeilen</translation>
    </message>
    <message>
        <source>duration</source>
        <translation>Dauer</translation>
    </message>
    <message>
        <source>rate</source>
        <translation>Rate</translation>
    </message>
    <message>
        <source>channels</source>
        <translation>Kanäle</translation>
    </message>
    <message>
        <source>loop</source>
        <translation>Regelkreis</translation>
    </message>
    <message>
        <source>history</source>
        <translation>Vorgeschichte</translation>
    </message>
    <message>
        <source>fingerprint</source>
        <translation>Fingerabdruck</translation>
    </message>
    <message>
        <source>Metadata of record {number}</source>
        <translation>Metadaten der Aufzeichnung {number}</translation>
    </message>
    <message>
        <source>gap [{unit}]</source>
        <translation>Abweichung [{unit}]</translation>
    </message>
    <message>
        <source>real</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>record {number}</source>
        <translation>Aufzeichnung {number}</translation>
    </message>
    <message>
        <source>time [s]</source>
        <translation>Zeit [s]</translation>
    </message>
    <message>
        <source>command [{unit}]</source>
        <translation>Sollwert [{unit}]</translation>
    </message>
    <message>
        <source>Gap before and after over time, reading over command and gap over command, of the records {numbers} at {tap}</source>
        <translation>Abweichung vorher und nachher über der Zeit, Messwert über dem Sollwert und Abweichung über dem Sollwert, der Aufzeichnungen {numbers} an {tap}</translation>
    </message>
    <message>
        <source>phase [°]</source>
        <translation>Phase [°]</translation>
    </message>
    <message>
        <source>frequency [Hz]</source>
        <translation>Frequenz [Hz]</translation>
    </message>
    <message>
        <source>Frequency response from command to {tap}: real, model, corrected model</source>
        <translation>Frequenzgang vom Sollwert zu {tap}: real, Modell, korrigiertes Modell</translation>
    </message>
    <message>
        <source>closed loop</source>
        <translation>geschlossener Regelkreis</translation>
    </message>
    <message>
        <source>open loop</source>
        <translation>offener Regelkreis</translation>
    </message>
    <message>
        <source>one row</source>
        <translation>eine Zeile</translation>
    </message>
    <message>
        <source>uneven, {rate} Hz on average</source>
        <translation>ungleichmäßig, im Mittel {rate} Hz</translation>
    </message>
    <message>
        <source>Of {all} records, the {drawn} with the largest gap are drawn.</source>
        <translation>Von {all} Aufzeichnungen sind die {drawn} mit der größten Abweichung gezeichnet.</translation>
    </message>
    <message>
        <source>No frequency response is drawn: {reason}.</source>
        <translation>Kein Frequenzgang ist gezeichnet: {reason}.</translation>
    </message>
    <message>
        <source>No heat map is drawn: no record is sampled evenly and long enough.</source>
        <translation>Keine Karte nach Band und Bewegungsart: keine Aufzeichnung ist gleichmäßig und lange genug abgetastet.</translation>
    </message>
    <message>
        <source>pause = {pause_s} s: must be 0 s or more</source>
        <translation>pause = {pause_s} s: muss 0 s oder mehr sein</translation>
    </message>
    <message>
        <source>axis {missing} of the commands is not in the previous motion, which has {names}; name a record of all commanded axes</source>
        <translation>Achse {missing} der Sollwerte fehlt in der Bewegung davor, die {names} hat; eine Aufzeichnung aller bewegten Achsen angeben</translation>
    </message>
    <message>
        <source>the previous motion and the commands differ in mode; name a record of the same mode</source>
        <translation>die Bewegung davor und die Sollwerte unterscheiden sich in mode; eine Aufzeichnung mit demselben mode angeben</translation>
    </message>
    <message>
        <source>axis {axis} of the commands is no axis of the diagnosed robot {name}, which has {names}</source>
        <translation>Achse {axis} der Sollwerte gibt es beim diagnostizierten Roboter {name} nicht; er hat {names}</translation>
    </message>
    <message>
        <source>axis {axis} of the commands is in units of {units}, but the diagnosed robot {name} moves it in units of {unit}; correct the unit</source>
        <translation>Achse {axis} der Sollwerte steht in Einheiten von {units}, der diagnostizierte Roboter {name} bewegt sie in Einheiten von {unit}; die Einheit berichtigen</translation>
    </message>
    <message>
        <source>{name}: {axis}.{tap} does not follow {axis}.cmd but {other}.cmd (its gain is {gain} ± {deviation}): channels may be swapped; correct the columns</source>
        <translation>{name}: {axis}.{tap} folgt nicht {axis}.cmd, sondern {other}.cmd (die Verstärkung ist {gain} ± {deviation}): vielleicht sind Kanäle vertauscht; die Spalten berichtigen</translation>
    </message>
    <message>
        <source>{name}: {axis}.{tap} does not follow {axis}.cmd (its gain is {gain} ± {deviation}); switch the axis on, or leave its columns out</source>
        <translation>{name}: {axis}.{tap} folgt {axis}.cmd nicht (die Verstärkung ist {gain} ± {deviation}); die Achse einschalten oder ihre Spalten weglassen</translation>
    </message>
    <message>
        <source>name the JSON file of a diagnosis</source>
        <translation>die JSON-Datei einer Diagnose angeben</translation>
    </message>
    <message>
        <source>the document</source>
        <translation>das Dokument</translation>
    </message>
    <message>
        <source>{name}: format = {short}: must be {format}; name a file that &apos;rotemina gap diagnose --json&apos; wrote</source>
        <translation>{name}: format = {short}: muss {format} sein; eine Datei angeben, die &apos;rotemina gap diagnose --json&apos; geschrieben hat</translation>
    </message>
    <message>
        <source>{name}: model.effects = {short}: must be a list</source>
        <translation>{name}: model.effects = {short}: muss eine Liste sein</translation>
    </message>
    <message>
        <source>{name}: {key} = {short}: must be an object; name a file that &apos;rotemina gap diagnose --json&apos; wrote</source>
        <translation>{name}: {key} = {short}: muss ein Objekt sein; eine Datei angeben, die &apos;rotemina gap diagnose --json&apos; geschrieben hat</translation>
    </message>
    <message>
        <source>{name}: {key} = {short}: must be one of {names}</source>
        <translation>{name}: {key} = {short}: muss eines von {names} sein</translation>
    </message>
    <message>
        <source>{name}: offset.{short}: must be one of {names}</source>
        <translation>{name}: offset.{short}: muss eines von {names} sein</translation>
    </message>
    <message>
        <source>{name}: {where}: must be one of {names}</source>
        <translation>{name}: {where}: muss eines von {names} sein</translation>
    </message>
    <message>
        <source>{name}: {key} = {short}: must be a finite number</source>
        <translation>{name}: {key} = {short}: muss eine endliche Zahl sein</translation>
    </message>
    <message>
        <source>{where} = {short}: must be the text of a robot file</source>
        <translation>{where} = {short}: muss der Text einer Roboterdatei sein</translation>
    </message>
    <message>
        <source>{where} = {short}: must be an object</source>
        <translation>{where} = {short}: muss ein Objekt sein</translation>
    </message>
    <message>
        <source>{where}.axis = {short}: must be one of {names}</source>
        <translation>{where}.axis = {short}: muss eine von {names} sein</translation>
    </message>
    <message>
        <source>{where}.parameters = {short}: must be an object</source>
        <translation>{where}.parameters = {short}: muss ein Objekt sein</translation>
    </message>
    <message>
        <source>{where}.parameters.{clashing}: no parameter has this name</source>
        <translation>{where}.parameters.{clashing}: kein Parameter heißt so</translation>
    </message>
    <message>
        <source>{where}: {error}</source>
        <translation>{where}: {error}</translation>
    </message>
    <message>
        <source>no gap: the model explains the records up to their noise</source>
        <translation>keine Abweichung: das Modell erklärt die Aufzeichnungen bis auf ihr Rauschen</translation>
    </message>
    <message>
        <source>the gap is explained</source>
        <translation>die Abweichung ist erklärt</translation>
    </message>
    <message>
        <source>the examination failed; the machine may have any gap</source>
        <translation>die Untersuchung ist fehlgeschlagen; über die Maschine sagt das nichts</translation>
    </message>
    <message>
        <source>no gap of its own</source>
        <translation>keine eigene Abweichung</translation>
    </message>
    <message>
        <source>unknown effect</source>
        <translation>unbekannter Effekt</translation>
    </message>
    <message>
        <source>insufficient excitation</source>
        <translation>unzureichende Anregung</translation>
    </message>
    <message>
        <source>not examined, because the program failed</source>
        <translation>nicht untersucht, weil das Programm versagt hat</translation>
    </message>
    <message>
        <source>where the gap lies</source>
        <translation>wo die Abweichung liegt</translation>
    </message>
    <message>
        <source>what causes it</source>
        <translation>was sie verursacht</translation>
    </message>
    <message>
        <source>experiment {number}, on {axis}: {why}</source>
        <translation>Experiment {number}, an {axis}: {why}</translation>
    </message>
    <message>
        <source>{name}: {what}</source>
        <translation>{name}: {what}</translation>
    </message>
    <message>
        <source>{share} of it</source>
        <translation>{share} davon</translation>
    </message>
    <message>
        <source>rms {rms}, noise floor {floor}</source>
        <translation>rms {rms}, Rauschgrenze {floor}</translation>
    </message>
    <message>
        <source>largest in: {regime}</source>
        <translation>am größten bei: {regime}</translation>
    </message>
    <message>
        <source>an unknown effect</source>
        <translation>ein unbekannter Effekt</translation>
    </message>
    <message>
        <source>{effect} ({stage})</source>
        <translation>{effect} ({stage})</translation>
    </message>
    <message>
        <source>{effect}, probability {probability}</source>
        <translation>{effect}, Wahrscheinlichkeit {probability}</translation>
    </message>
    <message>
        <source>closes {share}</source>
        <translation>schließt {share}</translation>
    </message>
    <message>
        <source>rms {before} without it, {after} with it</source>
        <translation>rms {before} ohne ihn, {after} mit ihm</translation>
    </message>
    <message>
        <source>rms {before}</source>
        <translation>rms {before}</translation>
    </message>
    <message>
        <source>{name} {value} ({interval})</source>
        <translation>{name} {value} ({interval})</translation>
    </message>
    <message>
        <source>{name} = {value}</source>
        <translation>{name} = {value}</translation>
    </message>
    <message>
        <source>at its {end} bound</source>
        <translation>an seiner Grenze ({end})</translation>
    </message>
    <message>
        <source>re-tuned {rms}</source>
        <translation>neu abgestimmt {rms}</translation>
    </message>
    <message>
        <source>corrected {rms}</source>
        <translation>korrigiert {rms}</translation>
    </message>
    <message>
        <source>black box {rms}</source>
        <translation>Black Box {rms}</translation>
    </message>
    <message>
        <source>floor {rms}</source>
        <translation>Rauschgrenze {rms}</translation>
    </message>
    <message>
        <source>closed {share}</source>
        <translation>geschlossen {share}</translation>
    </message>
    <message>
        <source>{name}: this file does not describe the diagnosed robot {robot_name} (differences: {differences}); diagnose again with this file, or omit it to write the diagnosed robot</source>
        <translation>{name}: diese Datei beschreibt nicht den diagnostizierten Roboter {robot_name} (Unterschiede: {differences}); mit dieser Datei neu diagnostizieren oder sie weglassen, um den diagnostizierten Roboter zu schreiben</translation>
    </message>
    <message>
        <source>{fspath} already exists; name another file</source>
        <translation>{fspath}: gibt es schon; eine andere Datei angeben</translation>
    </message>
    <message>
        <source>Record and signal</source>
        <translation>Aufzeichnung und Signal</translation>
    </message>
    <message>
        <source>{name}: no header; add this file alone to name its columns</source>
        <translation>{name}: ohne Kopfzeile; allein hinzufügen, um die Spalten zu benennen</translation>
    </message>
    <message>
        <source>The test draws machines with hidden effects, by equations that the diagnosis does not know. The names of the effects are sealed until the diagnosis has answered; then they are opened and compared. A case takes about half a minute. The test runs in the background; you can stop and resume it without losing finished cases.</source>
        <translation>Der Test lost Maschinen mit verborgenen Effekten aus, nach Gleichungen, die die Diagnose nicht kennt. Die Namen der Effekte sind versiegelt, bis die Diagnose geantwortet hat; dann werden sie geöffnet und verglichen. Ein Fall dauert etwa eine halbe Minute. Der Test läuft im Hintergrund und lässt sich anhalten und fortsetzen, ohne fertige Fälle zu verlieren.</translation>
    </message>
    <message>
        <source>No case is scored yet.
Press Start; figures and confusion matrix appear when all cases are done. To score earlier, press Stop, then “Score finished cases”.</source>
        <translation>Noch kein Fall ist bewertet.
Starten drücken; Kennwerte und Verwechslungsmatrix erscheinen, wenn alle Fälle fertig sind. Für eine frühere Bewertung Anhalten drücken, dann „Fertige bewerten“.</translation>
    </message>
    <message>
        <source>undecided</source>
        <translation>unentschieden</translation>
    </message>
    <message>
        <source>Number of machines, 1 to 9999</source>
        <translation>Anzahl der Maschinen, 1 bis 9999</translation>
    </message>
    <message>
        <source>Seed of the machines: the same seed draws the same machines</source>
        <translation>Startwert der Maschinen: derselbe Startwert ergibt dieselben Maschinen</translation>
    </message>
    <message>
        <source>Score finished cases</source>
        <translation>Fertige bewerten</translation>
    </message>
    <message>
        <source>True cause and cause named first</source>
        <translation>Wahre Ursache und zuerst genannte Ursache</translation>
    </message>
    <message>
        <source>stopping</source>
        <translation>wird angehalten</translation>
    </message>
    <message>
        <source>it is already running</source>
        <translation>er läuft schon</translation>
    </message>
    <message>
        <source>Run the unfinished cases, then score all</source>
        <translation>Die unfertigen Fälle rechnen, dann alle bewerten</translation>
    </message>
    <message>
        <source>Score the finished cases without running more</source>
        <translation>Die fertigen Fälle bewerten, ohne weitere zu rechnen</translation>
    </message>
    <message>
        <source>Stop the test; finished cases are kept</source>
        <translation>Den Test anhalten; fertige Fälle bleiben erhalten</translation>
    </message>
    <message>
        <source>Confusion matrix, cases with one effect at most: rows are true causes, columns are the causes named first</source>
        <translation>Verwechslungsmatrix, Fälle mit höchstens einem Effekt: Zeilen sind wahre Ursachen, Spalten die zuerst genannten</translation>
    </message>
    <message>
        <source>{folder}: cannot be created ({reason})</source>
        <translation>{folder}: lässt sich nicht anlegen ({reason})</translation>
    </message>
    <message>
        <source>scoring</source>
        <translation>wird bewertet</translation>
    </message>
    <message>
        <source>choosing the first machine</source>
        <translation>die erste Maschine wird ausgelost</translation>
    </message>
    <message>
        <source>enter cases and seed</source>
        <translation>Fälle und Startwert eingeben</translation>
    </message>
    <message>
        <source>nothing is running</source>
        <translation>nichts läuft</translation>
    </message>
    <message>
        <source>true cause</source>
        <translation>wahre Ursache</translation>
    </message>
    <message>
        <source>stopped; finished cases are kept</source>
        <translation>angehalten; fertige Fälle bleiben erhalten</translation>
    </message>
    <message>
        <source>Nominal → corrected, on validation data</source>
        <translation>Nominal → korrigiert, auf Prüfdaten</translation>
    </message>
    <message>
        <source>axis, signal</source>
        <translation>Achse, Signal</translation>
    </message>
    <message>
        <source>Rms of measurement minus model, including offset, during motion and 0.5 s after it; intervals by block bootstrap</source>
        <translation>Effektivwert von Messung minus Modell, mit Versatz, während der Bewegung und 0,5 s danach; Intervalle durch Block-Bootstrap</translation>
    </message>
    <message>
        <source>first cause correct, one effect</source>
        <translation>erste Ursache richtig, ein Effekt</translation>
    </message>
    <message>
        <source>exactly one effect and no other</source>
        <translation>genau ein Effekt und kein anderer</translation>
    </message>
    <message>
        <source>exactly two effects</source>
        <translation>genau zwei Effekte</translation>
    </message>
    <message>
        <source>exactly three effects</source>
        <translation>genau drei Effekte</translation>
    </message>
    <message>
        <source>false cause named</source>
        <translation>falsche Ursache genannt</translation>
    </message>
    <message>
        <source>verdict: explained or partly</source>
        <translation>Urteil: erklärt oder zum Teil</translation>
    </message>
    <message>
        <source>false alarms on healthy machines</source>
        <translation>Fehlalarme bei gesunden Maschinen</translation>
    </message>
    <message>
        <source>unknown effects recognised</source>
        <translation>unbekannte Effekte erkannt</translation>
    </message>
    <message>
        <source>poor excitation recognised</source>
        <translation>schlechte Anregung erkannt</translation>
    </message>
    <message>
        <source>… or exactly its cause named</source>
        <translation>… oder genau ihre Ursache genannt</translation>
    </message>
    <message>
        <source>seconds per case, median</source>
        <translation>Sekunden je Fall, Median</translation>
    </message>
    <message>
        <source>seconds per case, maximum</source>
        <translation>Sekunden je Fall, Maximum</translation>
    </message>
    <message>
        <source>seconds per healthy case, median</source>
        <translation>Sekunden je gesundem Fall, Median</translation>
    </message>
    <message>
        <source>Three or more records of different motions give the best diagnosis.</source>
        <translation>Drei oder mehr Aufzeichnungen verschiedener Bewegungen ergeben die beste Diagnose.</translation>
    </message>
    <message>
        <source>Gap from the model in use, of the axis with the most noise floors</source>
        <translation>Abweichung vom verwendeten Modell: die der Achse mit den meisten Rauschgrenzen</translation>
    </message>
    <message>
        <source>Records to diagnose:</source>
        <translation>Zu diagnostizierende Aufzeichnungen:</translation>
    </message>
    <message>
        <source>Rms of the gap on validation data: with the original model, with its own parameters re-tuned, then with one effect after the other. No model gets below the noise floor; the black-box model shows about how far any explanation can get.</source>
        <translation>Effektivwert der Abweichung auf Prüfdaten: mit dem ursprünglichen Modell, mit neu abgestimmten eigenen Parametern, dann mit einem Effekt nach dem anderen. Kein Modell kommt unter die Rauschgrenze; das Black-Box-Modell zeigt, wie weit eine Erklärung etwa kommen kann.</translation>
    </message>
    <message>
        <source>This axis has no gap to close.</source>
        <translation>Diese Achse hat keine Abweichung zu schließen.</translation>
    </message>
    <message>
        <source>Signal: u is the voltage, ref the reference sensor, meas the machine&apos;s own sensor</source>
        <translation>Signal: u ist die Spannung, ref der Referenzsensor, meas der eigene Sensor der Maschine</translation>
    </message>
    <message>
        <source>Rms of noise and rounding of the sensor, which no model explains</source>
        <translation>Effektivwert von Rauschen und Rundung des Sensors, die kein Modell erklärt</translation>
    </message>
    <message>
        <source>Band with the largest share</source>
        <translation>Band mit dem größten Anteil</translation>
    </message>
    <message>
        <source>Motion of the axis where the gap is largest</source>
        <translation>Bewegung der Achse, wo die Abweichung am größten ist</translation>
    </message>
    <message>
        <source>{share} of the gap of the channel</source>
        <translation>{share} der Abweichung des Kanals</translation>
    </message>
    <message>
        <source>{place}: no record is long enough and evenly sampled for a map</source>
        <translation>{place}: keine Aufzeichnung ist gleichmäßig und lang genug für eine Karte</translation>
    </message>
    <message>
        <source>Model to be diagnosed; initially the nominal one</source>
        <translation>Modell, das diagnostiziert wird; zunächst das nominale</translation>
    </message>
    <message>
        <source>Remainder of the model in use</source>
        <translation>Rest des verwendeten Modells</translation>
    </message>
    <message>
        <source>commands cannot predict any of the causes</source>
        <translation>keine der Ursachen lässt sich aus Sollwerten vorhersagen</translation>
    </message>
    <message>
        <source>there is no diagnosis yet; diagnose records first</source>
        <translation>es gibt noch keine Diagnose; zuerst Aufzeichnungen diagnostizieren</translation>
    </message>
    <message>
        <source>Candidates with their probabilities, explanation and advice</source>
        <translation>Kandidaten mit ihren Wahrscheinlichkeiten, Erklärung und Rat</translation>
    </message>
    <message>
        <source>How far the gap shrinks with the causes, down to the noise floor</source>
        <translation>Wie weit die Abweichung mit den Ursachen schrumpft, bis zur Rauschgrenze</translation>
    </message>
    <message>
        <source>Predictions only: commands to the machine do not change. The panel Compensation changes them.</source>
        <translation>Nur Vorhersagen: Sollwerte an die Maschine ändern sich nicht. Das tut das Panel Kompensation.</translation>
    </message>
    <message>
        <source>Save the diagnosis as JSON; test how often the diagnosis is correct</source>
        <translation>Die Diagnose als JSON speichern; testen, wie oft die Diagnose stimmt</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>waiting for the stopped work to end</source>
        <translation>wartet auf das Ende der angehaltenen Arbeit</translation>
    </message>
    <message>
        <source>The diagnosis failed; the notice above gives the reason.</source>
        <translation>Die Diagnose ist fehlgeschlagen; die Meldung oben nennt den Grund.</translation>
    </message>
    <message>
        <source>Find the effects that the model lacks</source>
        <translation>Die Effekte finden, die dem Modell fehlen</translation>
    </message>
    <message>
        <source>Choose records and diagnose them</source>
        <translation>Aufzeichnungen wählen und diagnostizieren</translation>
    </message>
    <message>
        <source>Stop the diagnosis; motion continues</source>
        <translation>Die Diagnose anhalten; die Bewegung läuft weiter</translation>
    </message>
    <message>
        <source>only the simulator can hide a machine</source>
        <translation>nur der Simulator kann eine Maschine verbergen</translation>
    </message>
    <message>
        <source>a machine is hidden already; reveal it first</source>
        <translation>eine Maschine ist schon verborgen; erst aufdecken</translation>
    </message>
    <message>
        <source>no machine is hidden</source>
        <translation>keine Maschine ist verborgen</translation>
    </message>
    <message>
        <source>Write a robot file of the model with the causes found</source>
        <translation>Eine Roboterdatei des Modells mit den gefundenen Ursachen schreiben</translation>
    </message>
    <message>
        <source>Play a motion that no record contains, and measure its gap</source>
        <translation>Eine Bewegung abspielen, die keine Aufzeichnung enthält, und ihre Abweichung messen</translation>
    </message>
    <message>
        <source>Write the report with all figures, and open it</source>
        <translation>Den Bericht mit allen Kennwerten schreiben und öffnen</translation>
    </message>
    <message>
        <source>Computing a motion …</source>
        <translation>Eine Bewegung wird berechnet …</translation>
    </message>
    <message>
        <source>Play the motion that best distinguishes the candidates, and diagnose its record with the others</source>
        <translation>Die Bewegung abspielen, die die Kandidaten am besten unterscheidet, und ihre Aufzeichnung mit den anderen diagnostizieren</translation>
    </message>
    <message>
        <source>a diagnosis is running</source>
        <translation>eine Diagnose läuft</translation>
    </message>
    <message>
        <source>A hidden machine is connected. It has one or two effects, or none. Play a motion, diagnose it, then choose More → Reveal.</source>
        <translation>Eine verborgene Maschine ist verbunden. Sie hat einen oder zwei Effekte oder keinen. Eine Bewegung abspielen, diagnostizieren, dann Mehr → Aufdecken wählen.</translation>
    </message>
    <message>
        <source>Correct: the diagnosis named exactly the effects of the machine.</source>
        <translation>Richtig: die Diagnose nannte genau die Effekte der Maschine.</translation>
    </message>
    <message>
        <source>Not correct.</source>
        <translation>Nicht richtig.</translation>
    </message>
    <message>
        <source>The machine has: {causes}</source>
        <translation>Die Maschine hat: {causes}</translation>
    </message>
    <message>
        <source>{path}: the result of the blind test cannot be read ({reason}); run it again</source>
        <translation>{path}: das Ergebnis des Blindtests lässt sich nicht lesen ({reason}); noch einmal starten</translation>
    </message>
    <message>
        <source>The motion differs from all records: choose this record too, and diagnose them together.</source>
        <translation>Die Bewegung unterscheidet sich von allen Aufzeichnungen: auch diese wählen und alle zusammen diagnostizieren.</translation>
    </message>
    <message>
        <source>The model is off by a constant, because the axis has a different history than in the records. Sweep its whole range once, and play the motion again.</source>
        <translation>Das Modell liegt um eine Konstante daneben, weil die Achse eine andere Vorgeschichte hat als in den Aufzeichnungen. Einmal ihren ganzen Bereich durchfahren und die Bewegung noch einmal abspielen.</translation>
    </message>
    <message>
        <source>The motion leaves the region of the records: choose this record too, and diagnose them together.</source>
        <translation>Die Bewegung verlässt den Bereich der Aufzeichnungen: auch diese Aufzeichnung wählen und alle zusammen diagnostizieren.</translation>
    </message>
    <message>
        <source>It takes {time:.3g} s after the move to its first row.</source>
        <translation>Sie dauert {time:.3g} s nach der Fahrt zur ersten Zeile.</translation>
    </message>
    <message>
        <source>Reading the records.</source>
        <translation>Die Aufzeichnungen werden gelesen.</translation>
    </message>
    <message>
        <source>Locating the gap by axis, channel and frequency.</source>
        <translation>Die Abweichung wird nach Achse, Kanal und Frequenz lokalisiert.</translation>
    </message>
    <message>
        <source>Screening all effects that the axis may have.</source>
        <translation>Alle Effekte, die die Achse haben kann, werden gesichtet.</translation>
    </message>
    <message>
        <source>Fitting the most likely candidates to the records, in parallel.</source>
        <translation>Die wahrscheinlichsten Kandidaten werden parallel an die Aufzeichnungen angepasst.</translation>
    </message>
    <message>
        <source>Deciding between the candidates on validation data.</source>
        <translation>Zwischen den Kandidaten wird an Prüfdaten entschieden.</translation>
    </message>
    <message>
        <source>A bar is the share of the gap that a candidate closes: outlined after screening, light after the fit, solid after the decision on validation data. The answer also considers which causes are needed together, and may differ.</source>
        <translation>Balken: Anteil der Abweichung, den ein Kandidat schließt; Umriss: nach der Vorauswahl; hell: nach der Anpassung; voll: nach der Entscheidung an Prüfdaten. Die Antwort prüft auch, welche Ursachen zusammen nötig sind, und kann abweichen.</translation>
    </message>
    <message>
        <source>1  Choose records of the real machine: choose files, or play a trajectory and use its record.
2  Diagnose: find where and why the model differs from the records.
3  Use the answer: add the causes to the model, check it with a new motion, keep the report.</source>
        <translation>1  Aufzeichnungen der echten Maschine wählen: Dateien, oder eine Trajektorie abspielen und ihre Aufzeichnung verwenden.
2  Diagnose: finden, wo und warum das Modell davon abweicht.
3  Die Antwort nutzen: die Ursachen ins Modell übernehmen, es mit einer neuen Bewegung prüfen, den Bericht behalten.</translation>
    </message>
    <message>
        <source>Press Diagnose to find where the model differs from the measurements, which effect it lacks, and how far the gap shrinks with that effect. This takes about half a minute for each axis with a gap; you can stop it at any time.</source>
        <translation>Diagnose drücken, um zu finden, wo das Modell von den Messungen abweicht, welcher Effekt ihm fehlt und wie weit die Abweichung damit schrumpft. Das dauert etwa eine halbe Minute je Achse mit einer Abweichung und lässt sich jederzeit anhalten.</translation>
    </message>
    <message>
        <source>The model matches the machine in these motions.</source>
        <translation>Das Modell stimmt in diesen Bewegungen mit der Maschine überein.</translation>
    </message>
    <message>
        <source>The model lacks the effects named below; with them, it follows the machine.</source>
        <translation>Dem Modell fehlen die unten genannten Effekte; mit ihnen folgt es der Maschine.</translation>
    </message>
    <message>
        <source>The effects named below are present; no effect of the catalogue explains the rest of the gap.</source>
        <translation>Die unten genannten Effekte liegen vor; den Rest der Abweichung erklärt kein Effekt des Katalogs.</translation>
    </message>
    <message>
        <source>Press “Use corrected model”: it follows the machine better. The page Where shows what the rest depends on.</source>
        <translation>„Korrigiertes Modell verwenden“ drücken: es folgt der Maschine besser. Die Seite Wo zeigt, wovon der Rest abhängt.</translation>
    </message>
    <message>
        <source>The gap is real, but no effect of the catalogue explains it.</source>
        <translation>Die Abweichung ist echt, aber kein Effekt des Katalogs erklärt sie.</translation>
    </message>
    <message>
        <source>The page Where shows what it depends on. Check cables, clamps and sensor; record again, slower and faster. Keep the report for the maintainer of the model.</source>
        <translation>Die Seite Wo zeigt, wovon sie abhängt. Kabel, Klemmen und Sensor prüfen; noch einmal langsamer und schneller aufzeichnen. Den Bericht für die Pflege des Modells behalten.</translation>
    </message>
    <message>
        <source>The program failed to examine this axis. This says nothing about the machine.</source>
        <translation>Das Programm konnte diese Achse nicht untersuchen. Das sagt nichts über die Maschine.</translation>
    </message>
    <message>
        <source>Save a support bundle with these records, and send it to the maintainer.</source>
        <translation>Speichern Sie ein Support-Paket mit diesen Aufzeichnungen, und senden Sie es an den Betreuer des Programms.</translation>
    </message>
    <message>
        <source>These motions cannot distinguish the effects: they are too short, too small or too similar.</source>
        <translation>Diese Bewegungen können die Effekte nicht unterscheiden: sie sind zu kurz, zu klein oder zu ähnlich.</translation>
    </message>
    <message>
        <source>Press “Play next experiment …” to distinguish them.</source>
        <translation>„Nächstes Experiment …“ drücken, um sie zu unterscheiden.</translation>
    </message>
    <message>
        <source>The corrected model is worse than the nominal one on {motion}: {axes}.</source>
        <translation>Bei {motion} ist das korrigierte Modell schlechter als das nominale: {axes}.</translation>
    </message>
    <message>
        <source>Predictions only: commands to the machine do not change, and no bound widens.</source>
        <translation>Nur Vorhersagen: Sollwerte an die Maschine ändern sich nicht, und keine Grenze wird weiter.</translation>
    </message>
    <message>
        <source>The model stays: {why}. Press Use corrected model again.</source>
        <translation>Das Modell bleibt: {why}. Noch einmal auf Korrigiertes Modell verwenden drücken.</translation>
    </message>
    <message>
        <source>validation data</source>
        <translation>Prüfdaten</translation>
    </message>
    <message>
        <source>The model includes {causes}: the axis may have touched something. A penetration ignores this and also detects the contact with the nominal model.</source>
        <translation>Das Modell enthält {causes}: die Achse hat vielleicht etwas berührt. Eine Penetration lässt das weg und sucht den Kontakt auch mit dem nominalen Modell.</translation>
    </message>
    <message>
        <source>During {record}: {noted}.</source>
        <translation>Während {record}: {noted}.</translation>
    </message>
    <message>
        <source>Alternatives to the leading cause, most likely first; possible causes are highlighted</source>
        <translation>Alternativen zur führenden Ursache, die wahrscheinlichste zuerst; mögliche Ursachen sind hervorgehoben</translation>
    </message>
    <message>
        <source>Probability of being the cause, among the candidates and an unknown cause</source>
        <translation>Wahrscheinlichkeit, die Ursache zu sein, unter den Kandidaten und einer unbekannten Ursache</translation>
    </message>
    <message>
        <source>Rms of the remaining gap on validation data, in noise floors; noise alone is 1</source>
        <translation>Effektivwert der restlichen Abweichung auf Prüfdaten, in Rauschgrenzen; Rauschen allein ist 1</translation>
    </message>
    <message>
        <source>    These records cannot distinguish it from {effects}.</source>
        <translation>    Diese Aufzeichnungen können es nicht unterscheiden von: {effects}.</translation>
    </message>
    <message>
        <source>Result for the axis</source>
        <translation>Ergebnis für die Achse</translation>
    </message>
    <message>
        <source>Result of the diagnosis for the axis</source>
        <translation>Ergebnis der Diagnose für die Achse</translation>
    </message>
    <message>
        <source>gap [{unit}]: &lt;span style=&quot;color:{command}&quot;&gt;total&lt;/span&gt;, &lt;span style=&quot;color:{real}&quot;&gt;in this band&lt;/span&gt;: {rms} rms in {time:.3g} s</source>
        <translation>Abweichung [{unit}]: &lt;span style=&quot;color:{command}&quot;&gt;gesamt&lt;/span&gt;, &lt;span style=&quot;color:{real}&quot;&gt;in diesem Band&lt;/span&gt;: {rms} rms in {time:.3g} s</translation>
    </message>
    <message>
        <source>the process of the diagnosis ended (status {status}) without an answer, perhaps for lack of memory; diagnose again with fewer or shorter records</source>
        <translation>der Prozess der Diagnose endete (Status {status}) ohne Antwort, vielleicht aus Mangel an Speicher; mit weniger oder kürzeren Aufzeichnungen neu diagnostizieren</translation>
    </message>
    <message>
        <source>; {rows} rows in pieces shorter than {least} are omitted</source>
        <translation>; {rows} Zeilen in Stücken von weniger als {least} bleiben weg</translation>
    </message>
    <message>
        <source>Time jumps {n} ×, by up to {time} s: the record is split there, and the history of each piece is unknown{left_out}.</source>
        <translation>Die Zeit springt {n} ×, um bis zu {time} s: die Aufzeichnung wird dort geteilt, und die Vorgeschichte jedes Stücks ist unbekannt{left_out}.</translation>
    </message>
    <message>
        <source>The reading drifts regardless of the motion, but the reference does not.</source>
        <translation>Der Messwert driftet unabhängig von der Bewegung, die Referenz aber nicht.</translation>
    </message>
    <message>
        <source>The reading drifts regardless of the motion, also at rest.</source>
        <translation>Der Messwert driftet unabhängig von der Bewegung, auch in Ruhe.</translation>
    </message>
    <message>
        <source>{name}: robot {robot_name} has no axis {axis}; its axes are {names}; select the right robot with --robot</source>
        <translation>{name}: Roboter {robot_name} hat keine Achse {axis}; seine Achsen sind {names}; den richtigen Roboter mit --robot angeben</translation>
    </message>
    <message>
        <source>{name}: axis {quoted} is moved by a force, but there is no {axis}.u column: add it, or write &apos;# mode: closed_loop&apos; and add the controller to the robot file</source>
        <translation>{name}: Achse {quoted} wird von einer Kraft bewegt, aber die Spalte {axis}.u fehlt: sie hinzufügen, oder &apos;# mode: closed_loop&apos; schreiben und den Regler in der Roboterdatei ergänzen</translation>
    </message>
    <message>
        <source>The axis was commanded but not measured: it is not diagnosed.</source>
        <translation>Die Achse bekam Sollwerte, wurde aber nicht gemessen: sie wird nicht diagnostiziert.</translation>
    </message>
    <message>
        <source>The axis was never commanded to move: only effects without motion are visible.</source>
        <translation>Die Achse sollte sich nie bewegen: nur Effekte ohne Bewegung sind sichtbar.</translation>
    </message>
    <message>
        <source>The axis&apos; own sensor was not recorded: it is not diagnosed.</source>
        <translation>Der eigene Sensor der Achse wurde nicht aufgezeichnet: er wird nicht diagnostiziert.</translation>
    </message>
    <message>
        <source>No independent reference (ref) was recorded: effects of the sensor cannot be distinguished from those of the axis.</source>
        <translation>Keine unabhängige Referenz (ref) wurde aufgezeichnet: Effekte des Sensors lassen sich nicht von denen der Achse trennen.</translation>
    </message>
    <message>
        <source>Its gap comes from the causes on other axes.</source>
        <translation>Ihre Abweichung kommt von den Ursachen an anderen Achsen.</translation>
    </message>
    <message>
        <source>; no test here distinguishes {any} from one of them</source>
        <translation>; kein Test hier trennt {any} von einem davon</translation>
    </message>
    <message>
        <source>, if the reference (ref) of {axis} is recorded too: without it, the test does not distinguish {effects}</source>
        <translation>, wenn auch die Referenz (ref) von {axis} aufgezeichnet wird: ohne sie trennt es {effects} nicht</translation>
    </message>
    <message>
        <source>The records move {axis} too little to distinguish effects. Play this: {test}; it covers many amplitudes and speeds.</source>
        <translation>Die Aufzeichnungen bewegen {axis} zu wenig, um Effekte zu unterscheiden. Dies abspielen: {test}; es durchläuft viele Amplituden und Geschwindigkeiten.</translation>
    </message>
    <message>
        <source>A vibration of {frequencies}, independent of the axis, was removed.</source>
        <translation>Eine Schwingung von {frequencies}, unabhängig von der Achse, wurde entfernt.</translation>
    </message>
    <message>
        <source>{n} sudden jumps by whole multiples of four full steps were removed.</source>
        <translation>{n} plötzliche Sprünge um ganze Vielfache von vier Vollschritten wurden entfernt.</translation>
    </message>
    <message>
        <source>The reading stays at exactly {stand} for {percent} % of the rows, while the axis is commanded to move: either the axis does not follow, or the sensor is {fault}. The records cannot distinguish the two.</source>
        <translation>Der Messwert bleibt in {percent} % der Zeilen auf genau {stand}, während die Achse sich bewegen soll: Entweder folgt die Achse nicht, oder der Sensor ist {fault}. Die Aufzeichnungen können beides nicht unterscheiden.</translation>
    </message>
    <message>
        <source>The rest depends on {groups}; no known effect explains it.</source>
        <translation>Der Rest hängt ab von: {groups}. Kein bekannter Effekt erklärt ihn.</translation>
    </message>
    <message>
        <source>{axis}: the records do not move the axis enough for a diagnosis.</source>
        <translation>{axis}: Die Aufzeichnungen bewegen die Achse zu wenig für eine Diagnose.</translation>
    </message>
    <message>
        <source>No known effect explains the rest.</source>
        <translation>Den Rest erklärt kein bekannter Effekt.</translation>
    </message>
    <message>
        <source>{effects} (these records cannot distinguish them)</source>
        <translation>{effects} (diese Aufzeichnungen unterscheiden sie nicht)</translation>
    </message>
    <message>
        <source>{n} of {all} records use another origin of position: effects locked to the position have the same period in all records, but another phase in these.</source>
        <translation>{n} von {all} Aufzeichnungen haben einen anderen Nullpunkt der Position: an die Position gebundene Effekte haben in allen dieselbe Periode, in diesen aber eine andere Phase.</translation>
    </message>
    <message>
        <source>the gap is partly explained; the cause of the rest is unknown</source>
        <translation>die Abweichung ist zum Teil erklärt; die Ursache des Rests ist nicht bekannt</translation>
    </message>
    <message>
        <source>no known effect explains the gap</source>
        <translation>kein bekannter Effekt erklärt die Abweichung</translation>
    </message>
    <message>
        <source>undecided: the records lack excitation</source>
        <translation>unentschieden: die Aufzeichnungen regen zu wenig an</translation>
    </message>
    <message>
        <source>partly explained</source>
        <translation>zum Teil erklärt</translation>
    </message>
    <message>
        <source>mostly between {low} and {high} Hz</source>
        <translation>am meisten zwischen {low} und {high} Hz</translation>
    </message>
    <message>
        <source>not distinguishable from: {names}</source>
        <translation>nicht zu unterscheiden von: {names}</translation>
    </message>
    <message>
        <source>how far it shrinks, rms on validation data</source>
        <translation>wie weit sie schrumpft, rms auf Prüfdaten</translation>
    </message>
    <message>
        <source>suggested experiments</source>
        <translation>vorgeschlagene Experimente</translation>
    </message>
    <message>
        <source>original {rms}</source>
        <translation>ursprünglich {rms}</translation>
    </message>
    <message>
        <source>Rows are missing in a record for up to {time} s while no axis moves; the commands are assumed constant meanwhile.</source>
        <translation>In einer Aufzeichnung fehlen Zeilen für bis zu {time} s, während sich keine Achse bewegt; die Sollwerte gelten dabei als konstant.</translation>
    </message>
    <message>
        <source>Rows of a record are {low} to {high} s apart; if a computer instead of the device took these times, their scatter appears as sensor noise.</source>
        <translation>Zeilen einer Aufzeichnung liegen {low} bis {high} s auseinander; stammen diese Zeiten von einem Rechner statt vom Gerät, erscheint ihre Streuung als Sensorrauschen.</translation>
    </message>
    <message>
        <source>Rows are missing at {n} places of a record; the commands are assumed constant there.</source>
        <translation>An {n} Stellen einer Aufzeichnung fehlen Zeilen; die Sollwerte gelten dort als konstant.</translation>
    </message>
    <message>
        <source>{name}: &apos;# history: periodic&apos; with period_samples = {period}, but {axis}.cmd at row {row} differs from its value one period earlier; correct period_samples, or write &apos;# history: unknown&apos;</source>
        <translation>{name}: &apos;# history: periodic&apos; mit period_samples = {period}, aber {axis}.cmd weicht in Zeile {row} von seinem Wert eine Periode früher ab; period_samples berichtigen oder &apos;# history: unknown&apos; schreiben</translation>
    </message>
    <message>
        <source>A command of {value} is outside the range {low} to {high}; the model has no end stops.</source>
        <translation>Ein Sollwert von {value} liegt außerhalb des Bereichs {low} bis {high}; das Modell hat keine Anschläge.</translation>
    </message>
    <message>
        <source>{name}: {axis}.{tap} is {gain} × {axis}.cmd: this looks like a unit error, a factor of {text}; correct the unit of the wrong column</source>
        <translation>{name}: {axis}.{tap} ist das {gain}-Fache von {axis}.cmd: das sieht nach einem Einheitenfehler aus, einem Faktor {text}; die Einheit der falschen Spalte berichtigen</translation>
    </message>
    <message>
        <source>The {tap} channel is {gain} × the command, which no single effect causes: check signs, units and the gain in the robot file.</source>
        <translation>Der Kanal {tap} ist {gain} × der Sollwert, was kein einzelner Effekt verursacht: Vorzeichen, Einheiten und Verstärkung in der Roboterdatei prüfen.</translation>
    </message>
    <message>
        <source>series of steps</source>
        <translation>Folge von Sprüngen</translation>
    </message>
    <message>
        <source>one step back and forth with very long holds</source>
        <translation>ein Sprung hin und zurück mit sehr langem Halten</translation>
    </message>
    <message>
        <source>share of the channel</source>
        <translation>Anteil am Kanal</translation>
    </message>
    <message>
        <source>{share} of the channel</source>
        <translation>{share} des Kanals</translation>
    </message>
    <message>
        <source>Partly explained: the cause of the rest is unknown</source>
        <translation>Zum Teil erklärt: die Ursache des Rests ist unbekannt</translation>
    </message>
    <message>
        <source>Unknown: no effect of the catalogue explains the gap</source>
        <translation>Unbekannt: kein Effekt des Katalogs erklärt die Abweichung</translation>
    </message>
    <message>
        <source>Undecided: the records lack excitation</source>
        <translation>Unentschieden: die Aufzeichnungen regen zu wenig an</translation>
    </message>
    <message>
        <source>Partly explained</source>
        <translation>Zum Teil erklärt</translation>
    </message>
    <message>
        <source>original model</source>
        <translation>ursprüngliches Modell</translation>
    </message>
    <message>
        <source>the records move none of these axes: {axes}; play a motion of your own</source>
        <translation>die Aufzeichnungen bewegen keine dieser Achsen: {axes}; eine eigene Bewegung abspielen</translation>
    </message>
    <message>
        <source>{name}: it contains the same measurements as {one_name} ({channel}); give each record once, and parts of one record without overlap</source>
        <translation>{name}: enthält dieselben Messungen wie {one_name} ({channel}); jede Aufzeichnung einmal angeben und Teile ohne Überschneidung</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Gap diagnosis</source>
        <translation>Abweichungsdiagnose</translation>
    </message>
</context>
</TS>
