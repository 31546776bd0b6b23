<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>identification</name>
    <message>
        <source>output error</source>
        <translation>OE</translation>
    </message>
    <message>
        <source>Open …</source>
        <translation>Öffnen …</translation>
    </message>
    <message>
        <source>Open a record for this page alone</source>
        <translation>Eine Aufzeichnung nur für diese Seite öffnen</translation>
    </message>
    <message>
        <source>Excite</source>
        <translation>Anregen</translation>
    </message>
    <message>
        <source>Choose a motion that excites an axis, play it, and look at it</source>
        <translation>Eine Bewegung wählen, die eine Achse anregt, abspielen und ansehen</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>Input</source>
        <translation>Eingang</translation>
    </message>
    <message>
        <source>Output</source>
        <translation>Ausgang</translation>
    </message>
    <message>
        <source>What is shown</source>
        <translation>Was gezeigt wird</translation>
    </message>
    <message>
        <source>{n} averages</source>
        <translation>{n} Mittel</translation>
    </message>
    <message>
        <source>Averages</source>
        <translation>Mittelungen</translation>
    </message>
    <message>
        <source>Segments of Welch&apos;s method: more are smoother, fewer resolve narrower peaks. A periodic record is averaged over its periods instead.</source>
        <translation>Segmente nach Welch: mehr sind glatter, weniger lösen schmalere Spitzen auf. Eine periodische Aufzeichnung wird stattdessen über ihre Perioden gemittelt.</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>1 pole</source>
        <translation>1 Pol</translation>
    </message>
    <message>
        <source>{n} poles</source>
        <translation>{n} Pole</translation>
    </message>
    <message>
        <source>Poles</source>
        <translation>Pole</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>Kopieren</translation>
    </message>
    <message>
        <source>Save …</source>
        <translation>Sichern …</translation>
    </message>
    <message>
        <source>Copy the figures as text</source>
        <translation>Die Kennwerte als Text kopieren</translation>
    </message>
    <message>
        <source>Write the figures into a file</source>
        <translation>Die Kennwerte in eine Datei schreiben</translation>
    </message>
    <message>
        <source>Keep card</source>
        <translation>Karte behalten</translation>
    </message>
    <message>
        <source>Write this health card behind the earlier ones of the axis</source>
        <translation>Diese Zustandskarte hinter die früheren der Achse schreiben</translation>
    </message>
    <message>
        <source>from {tap}</source>
        <translation>von {tap}</translation>
    </message>
    <message>
        <source>to {tap}</source>
        <translation>bis {tap}</translation>
    </message>
    <message>
        <source>Multisine</source>
        <translation>Multisinus</translation>
    </message>
    <message>
        <source>Sine</source>
        <translation>Sinus</translation>
    </message>
    <message>
        <source>Triangle</source>
        <translation>Dreieck</translation>
    </message>
    <message>
        <source>Staircase</source>
        <translation>Treppe</translation>
    </message>
    <message>
        <source>{low} to {high}, at most {speed}, {time}</source>
        <translation>{low} bis {high}, höchstens {speed}, {time}</translation>
    </message>
    <message>
        <source>{low} to {high}, at most {speed} of {bound}, {time}</source>
        <translation>{low} bis {high}, höchstens {speed} von {bound}, {time}</translation>
    </message>
    <message>
        <source>Changed: {change}.</source>
        <translation>Geändert: {change}.</translation>
    </message>
    <message>
        <source>Dry run: inside all limits and the tip&apos;s bounds.</source>
        <translation>Trockenlauf: innerhalb aller Grenzen, auch der Spitze.</translation>
    </message>
    <message>
        <source>Not playable: {reason}</source>
        <translation>Nicht abspielbar: {reason}</translation>
    </message>
    <message>
        <source>frequency</source>
        <translation>Frequenz</translation>
    </message>
    <message>
        <source>time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>{name}: {text} is no number of {unit}; write it like 2.5 {unit}, or leave it empty</source>
        <translation>{name}: {text} ist keine Zahl in {unit}; wie 2.5 {unit} schreiben oder leer lassen</translation>
    </message>
    <message>
        <source>Making the motion, and trying it on the model …</source>
        <translation>Die Bewegung wird erstellt und am Modell geprüft …</translation>
    </message>
    <message>
        <source>Amplitude. To each side of the middle, such as 5um, 200urad or 30% of the range; what exceeds a limit is reduced, and said</source>
        <translation>Amplitude. Zu jeder Seite der Mitte, wie 5um, 200urad oder 30% des Bereichs; was eine Grenze überschreitet, wird verkleinert und gemeldet</translation>
    </message>
    <message>
        <source>Amplitude of the excitation</source>
        <extracomment>To be played as soon as it is in hand.</extracomment>
        <translation>Amplitude der Anregung</translation>
    </message>
    <message>
        <source>amplitude</source>
        <translation>Amplitude</translation>
    </message>
    <message>
        <source>Frequency of the excitation</source>
        <translation>Frequenz der Anregung</translation>
    </message>
    <message>
        <source>Frequency, above 0 Hz; of a multisine the highest</source>
        <translation>Frequenz, über 0 Hz; bei einem Multisinus die höchste</translation>
    </message>
    <message>
        <source>Time of the excitation</source>
        <translation>Zeit der Anregung</translation>
    </message>
    <message>
        <source>Duration, above 0 s; of a staircase the rest on each level</source>
        <translation>Dauer, über 0 s; bei einer Treppe die Ruhe auf jeder Stufe</translation>
    </message>
    <message>
        <source>about here</source>
        <translation>um hier</translation>
    </message>
    <message>
        <source>Move about where the axis stands; off: about the middle of its range</source>
        <translation>Um die Stelle bewegen, an der die Achse steht; aus: um die Mitte ihres Bereichs</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Halt</translation>
    </message>
    <message>
        <source>Play it; the record is analysed at once</source>
        <translation>Abspielen; die Aufzeichnung wird sofort ausgewertet</translation>
    </message>
    <message>
        <source>Stop the machine, and end it</source>
        <translation>Die Maschine anhalten und es beenden</translation>
    </message>
    <message>
        <source>{axis}: free</source>
        <translation>{axis}: frei</translation>
    </message>
    <message>
        <source>{axis}: driven by {driver}</source>
        <translation>{axis}: bewegt von {driver}</translation>
    </message>
    <message>
        <source>it is not playing</source>
        <translation>es wird nicht abgespielt</translation>
    </message>
    <message>
        <source>the motion is not ready</source>
        <translation>die Bewegung ist nicht fertig</translation>
    </message>
    <message>
        <source>a trajectory is playing</source>
        <translation>eine Trajektorie wird abgespielt</translation>
    </message>
    <message>
        <source>the axes still move</source>
        <translation>die Achsen bewegen sich noch</translation>
    </message>
    <message>
        <source>up to [Hz]</source>
        <translation>bis [Hz]</translation>
    </message>
    <message>
        <source>frequency [Hz]</source>
        <translation>Frequenz [Hz]</translation>
    </message>
    <message>
        <source>rest [s]</source>
        <translation>Ruhe [s]</translation>
    </message>
    <message>
        <source>duration [s]</source>
        <translation>Dauer [s]</translation>
    </message>
    <message>
        <source>Axis to excite</source>
        <translation>Anzuregende Achse</translation>
    </message>
    <message>
        <source>Axis to excite; the others stand still</source>
        <translation>Anzuregende Achse; die anderen stehen still</translation>
    </message>
    <message>
        <source>Motion of the excitation</source>
        <translation>Bewegung der Anregung</translation>
    </message>
    <message>
        <source>Motion of the excitation: what each tells is in the help (F1)</source>
        <translation>Bewegung der Anregung: was jede zeigt, steht in der Hilfe (F1)</translation>
    </message>
    <message>
        <source>{tip}; empty: what suits the axis</source>
        <translation>{tip}; leer: was zur Achse passt</translation>
    </message>
    <message>
        <source>a fault of the program: {kind}: {error}</source>
        <translation>ein Fehler des Programms: {kind}: {error}</translation>
    </message>
    <message>
        <source>figure</source>
        <translation>Kennwert</translation>
    </message>
    <message>
        <source>value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>± deviation</source>
        <translation>± Abweichung</translation>
    </message>
    <message>
        <source>model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Fitted to the first {n} of {rows} rows: more would take long.</source>
        <translation>Angepasst an die ersten {n} von {rows} Zeilen: mehr würde lange dauern.</translation>
    </message>
    <message>
        <source>time [s]</source>
        <translation>Zeit [s]</translation>
    </message>
    <message>
        <source>fitted</source>
        <translation>angepasst</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>measured − fitted [{unit}]</source>
        <translation>gemessen − angepasst [{unit}]</translation>
    </message>
    <message>
        <source>fit</source>
        <translation>Anpassung</translation>
    </message>
    <message>
        <source>fit of one step ahead</source>
        <translation>Anpassung einen Schritt voraus</translation>
    </message>
    <message>
        <source>static gain</source>
        <translation>statische Verstärkung</translation>
    </message>
    <message>
        <source>residual rms</source>
        <translation>Restfehler rms</translation>
    </message>
    <message>
        <source>delay in samples</source>
        <translation>Totzeit in Abtastungen</translation>
    </message>
    <message>
        <source>natural frequency</source>
        <translation>Eigenfrequenz</translation>
    </message>
    <message>
        <source>damping ratio</source>
        <translation>Dämpfungsgrad</translation>
    </message>
    <message>
        <source>corner frequency</source>
        <translation>Eckfrequenz</translation>
    </message>
    <message>
        <source>time constant</source>
        <translation>Zeitkonstante</translation>
    </message>
    <message>
        <source>The fitted model is unstable: it stands for noise or drift; fit by output error.</source>
        <translation>Das angepasste Modell ist instabil: es steht für Rauschen oder Drift; nach Ausgangsfehler anpassen.</translation>
    </message>
    <message>
        <source>Fit {fit:.1f} %, below {bound:g} %: noise, distortion, another axis or too few poles; frequency and damping are not those of the machine.</source>
        <translation>Anpassung {fit:.1f} %, unter {bound:g} %: Rauschen, Verzerrung, eine andere Achse oder zu wenige Pole; Frequenz und Dämpfung sind nicht die der Maschine.</translation>
    </message>
    <message>
        <source>One step ahead it fits {ahead:.1f} %, simulated {fit:.1f} %: noise of the sensor spoils ARX; fit by output error.</source>
        <translation>Einen Schritt voraus passt es zu {ahead:.1f} %, simuliert zu {fit:.1f} %: Sensorrauschen verdirbt ARX; nach Ausgangsfehler anpassen.</translation>
    </message>
    <message>
        <source>The leading pole is real: the record shows a lag, no resonance.</source>
        <translation>Der führende Pol ist reell: die Aufzeichnung zeigt eine Verzögerung, keine Resonanz.</translation>
    </message>
    <message>
        <source>{mode:.4g} Hz lies above {highest:.4g} Hz, {share:g} of half the sampling rate: it is a delay or noise, and no mode of the machine.</source>
        <translation>{mode:.4g} Hz liegt über {highest:.4g} Hz, {share:g} der halben Abtastrate: es ist eine Totzeit oder Rauschen und keine Eigenform der Maschine.</translation>
    </message>
    <message>
        <source>The frequency is known to {deviation:.2g} Hz alone, more than {rough:.0f} %: the record hardly excites it; use faster steps or a multisine.</source>
        <translation>Die Frequenz ist nur auf {deviation:.2g} Hz bekannt, mehr als {rough:.0f} %: die Aufzeichnung regt sie kaum an; schnellere Schritte oder einen Multisinus verwenden.</translation>
    </message>
    <message>
        <source>multisine</source>
        <translation>Multisinus</translation>
    </message>
    <message>
        <source>{n} periods of {rows}</source>
        <translation>{n} Perioden zu {rows}</translation>
    </message>
    <message>
        <source>frequency response: {n} samples in {averages} averages leave segments of {segment}; at least {least} are needed, record longer or average less</source>
        <translation>Frequenzgang: {n} Abtastungen in {averages} Mittelungen ergeben Segmente von {segment}; mindestens {least} sind nötig, länger aufzeichnen oder weniger mitteln</translation>
    </message>
    <message>
        <source>{n} segments of {rows}</source>
        <translation>{n} Segmente zu {rows}</translation>
    </message>
    <message>
        <source>phase [°]</source>
        <translation>Phase [°]</translation>
    </message>
    <message>
        <source>coherence</source>
        <translation>Kohärenz</translation>
    </message>
    <message>
        <source>gain, lowest line</source>
        <translation>Verstärkung, tiefste Linie</translation>
    </message>
    <message>
        <source>largest gain</source>
        <translation>größte Verstärkung</translation>
    </message>
    <message>
        <source>at</source>
        <translation>bei</translation>
    </message>
    <message>
        <source>median coherence</source>
        <translation>mediane Kohärenz</translation>
    </message>
    <message>
        <source>estimator</source>
        <translation>Schätzer</translation>
    </message>
    <message>
        <source>averages</source>
        <translation>Mittelungen</translation>
    </message>
    <message>
        <source>lines</source>
        <translation>Linien</translation>
    </message>
    <message>
        <source>lowest line</source>
        <translation>tiefste Linie</translation>
    </message>
    <message>
        <source>highest line</source>
        <translation>höchste Linie</translation>
    </message>
    <message>
        <source>resolution</source>
        <translation>Auflösung</translation>
    </message>
    <message>
        <source>samples</source>
        <translation>Abtastungen</translation>
    </message>
    <message>
        <source>sampling rate</source>
        <translation>Abtastrate</translation>
    </message>
    <message>
        <source>resonance</source>
        <translation>Resonanz</translation>
    </message>
    <message>
        <source>misfit of the mode</source>
        <translation>Fehlanpassung</translation>
    </message>
    <message>
        <source>The input excites {n} lines alone, up to {highest:.4g} Hz ({wanted} are wanted): nothing is known above; record a multisine or a chirp.</source>
        <translation>Der Eingang regt nur {n} Linien an, bis {highest:.4g} Hz ({wanted} sind erwünscht): darüber ist nichts bekannt; einen Multisinus oder Chirp aufzeichnen.</translation>
    </message>
    <message>
        <source>Coherence is below {bound:g} on {n} of {lines} lines: noise, distortion, another axis or leakage; look at the interval there.</source>
        <translation>Die Kohärenz liegt bei {n} von {lines} Linien unter {bound:g}: Rauschen, Verzerrung, eine andere Achse oder Leckeffekt; dort auf das Intervall achten.</translation>
    </message>
    <message>
        <source>The resonance is {width:.3g} Hz wide, less than {lines} lines of {resolution:.3g} Hz: it looks flatter than it is; average less or record longer.</source>
        <translation>Die Resonanz ist {width:.3g} Hz breit, weniger als {lines} Linien zu {resolution:.3g} Hz: sie erscheint flacher, als sie ist; weniger mitteln oder länger aufzeichnen.</translation>
    </message>
    <message>
        <source>One mode misses the peak by {misfit:.0f} % (bound {bound:.0f} %): there may be two; damping is rough.</source>
        <translation>Eine Eigenform verfehlt die Spitze um {misfit:.0f} % (Grenze {bound:.0f} %): es können zwei sein; die Dämpfung ist ungenau.</translation>
    </message>
    <message>
        <source>now</source>
        <translation>jetzt</translation>
    </message>
    <message>
        <source>last time</source>
        <translation>zuletzt</translation>
    </message>
    <message>
        <source>gain</source>
        <translation>Verstärkung</translation>
    </message>
    <message>
        <source>damping</source>
        <translation>Dämpfung</translation>
    </message>
    <message>
        <source>hysteresis width</source>
        <translation>Hysteresebreite</translation>
    </message>
    <message>
        <source>settling</source>
        <translation>Einschwingzeit</translation>
    </message>
    <message>
        <source>repeatability</source>
        <translation>Wiederholgenauigkeit</translation>
    </message>
    <message>
        <source>changed</source>
        <translation>geändert</translation>
    </message>
    <message>
        <source>No card of this axis is kept yet: keep this one to compare with it later.</source>
        <translation>Von dieser Achse gibt es noch keine Karte: diese behalten, um später zu vergleichen.</translation>
    </message>
    <message>
        <source>Last card: {date}, the latest of {n}. Changed beyond both intervals: {figures}.</source>
        <translation>Letzte Karte: {date}, die neueste von {n}. Über beide Intervalle hinaus geändert: {figures}.</translation>
    </message>
    <message>
        <source>Last card: {date}, the latest of {n}. No figure has changed beyond both intervals.</source>
        <translation>Letzte Karte: {date}, die neueste von {n}. Kein Kennwert hat sich über beide Intervalle hinaus geändert.</translation>
    </message>
    <message>
        <source>Measured are the cycles of the first {n} of {rows} rows, which turn {turns} times: the input is noise or very long.</source>
        <translation>Gemessen sind die Zyklen der ersten {n} von {rows} Zeilen, die {turns}-mal umkehren: der Eingang ist Rauschen oder sehr lang.</translation>
    </message>
    <message>
        <source>Drawn are the first {n} of {rows} rows; the figures are not cut there.</source>
        <translation>Gezeichnet sind die ersten {n} von {rows} Zeilen; die Kennwerte enden dort nicht.</translation>
    </message>
    <message>
        <source>off a straight line</source>
        <translation>ohne Gerade</translation>
    </message>
    <message>
        <source>{title} [{unit}]</source>
        <translation>{title} [{unit}]</translation>
    </message>
    <message>
        <source>input span</source>
        <translation>Eingangsspanne</translation>
    </message>
    <message>
        <source>stroke</source>
        <translation>Hub</translation>
    </message>
    <message>
        <source>largest width</source>
        <translation>größte Breite</translation>
    </message>
    <message>
        <source>width at the middle</source>
        <translation>Breite in der Mitte</translation>
    </message>
    <message>
        <source>width over stroke</source>
        <translation>Breite je Hub</translation>
    </message>
    <message>
        <source>play across</source>
        <translation>Spiel quer</translation>
    </message>
    <message>
        <source>area</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>width ∝ amplitude^p</source>
        <translation>Breite ∝ Amplitude^p</translation>
    </message>
    <message>
        <source>cycles</source>
        <translation>Zyklen</translation>
    </message>
    <message>
        <source>too alike</source>
        <translation>zu ähnlich</translation>
    </message>
    <message>
        <source>A cycle has {rows:.0f} rows, fewer than {least}: the loop is that of lag and resonance; drive slower cycles.</source>
        <translation>Ein Zyklus hat {rows:.0f} Zeilen, weniger als {least}: die Schleife ist die von Verzögerung und Resonanz; langsamere Zyklen fahren.</translation>
    </message>
    <message>
        <source>Width below 0: the output leads, or the {lag} sample of lag that is taken out for a held command is more than the axis has; drive slower cycles.</source>
        <translation>Breite unter 0: der Ausgang eilt vor, oder die {lag} Abtastung Verzögerung, die für einen gehaltenen Sollwert abgezogen wird, ist mehr, als die Achse hat; langsamere Zyklen fahren.</translation>
    </message>
    <message>
        <source>Width below 0: the output leads the input.</source>
        <translation>Breite unter 0: der Ausgang eilt dem Eingang vor.</translation>
    </message>
    <message>
        <source>No nominal model beside it: {reason}</source>
        <translation>Kein nominelles Modell daneben: {reason}</translation>
    </message>
    <message>
        <source>Excite an axis, play a trajectory, or open a record, to see what it says about the machine.</source>
        <translation>Eine Achse anregen, eine Trajektorie abspielen oder eine Aufzeichnung öffnen, um zu sehen, was sie über die Maschine sagt.</translation>
    </message>
    <message>
        <source>Records (*.csv *.txt *.dat *.gz);;All files (*)</source>
        <translation>Aufzeichnungen (*.csv *.txt *.dat *.gz);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Figures</source>
        <translation>Kennwerte</translation>
    </message>
    <message>
        <source>Reading {name} …</source>
        <translation>{name} wird gelesen …</translation>
    </message>
    <message>
        <source>Open record</source>
        <translation>Aufzeichnung öffnen</translation>
    </message>
    <message>
        <source>{record}: axis {axis} has no pair of an input and an output.</source>
        <translation>{record}: Achse {axis} hat kein Paar aus Eingang und Ausgang.</translation>
    </message>
    <message>
        <source>{record}: computing …</source>
        <translation>{record}: wird berechnet …</translation>
    </message>
    <message>
        <source>Identification of {record} …</source>
        <translation>Identifikation von {record} …</translation>
    </message>
    <message>
        <source>{record}: {time:.3f} s, {n} samples</source>
        <translation>{record}: {time:.3f} s, {n} Werte</translation>
    </message>
    <message>
        <source>Keeping the health card …</source>
        <translation>Zustandskarte wird behalten …</translation>
    </message>
    <message>
        <source>Kept the health card of {axis}</source>
        <translation>Zustandskarte von {axis} behalten</translation>
    </message>
    <message>
        <source>Save results</source>
        <translation>Ergebnisse sichern</translation>
    </message>
    <message>
        <source>Tables (*.csv)</source>
        <translation>Tabellen (*.csv)</translation>
    </message>
    <message>
        <source>Writing {name} …</source>
        <translation>{name} wird geschrieben …</translation>
    </message>
    <message>
        <source>Saved {path}</source>
        <translation>Gespeichert: {path}</translation>
    </message>
    <message>
        <source>What the record cannot tell</source>
        <translation>Was die Aufzeichnung nicht sagen kann</translation>
    </message>
    <message>
        <source>{axis}: input and output are both {tap}; choose two taps</source>
        <translation>{axis}: Eingang und Ausgang sind beide {tap}; zwei Abgriffe wählen</translation>
    </message>
    <message>
        <source>{axis}: the record has no {axis}.{tap}; it has {columns}</source>
        <translation>{axis}: die Aufzeichnung hat kein {axis}.{tap}; sie hat {columns}</translation>
    </message>
    <message>
        <source>steps</source>
        <translation>Schritte</translation>
    </message>
    <message>
        <source>size of the step</source>
        <translation>Schrittgröße</translation>
    </message>
    <message>
        <source>rise 10–90 %</source>
        <translation>Anstieg 10–90 %</translation>
    </message>
    <message>
        <source>delay to 50 %</source>
        <translation>Totzeit bis 50 %</translation>
    </message>
    <message>
        <source>overshoot</source>
        <translation>Überschwingen</translation>
    </message>
    <message>
        <source>settling to 5 %</source>
        <translation>Einschwingen auf 5 %</translation>
    </message>
    <message>
        <source>settling to 2 %</source>
        <translation>Einschwingen auf 2 %</translation>
    </message>
    <message>
        <source>final error</source>
        <translation>Endfehler</translation>
    </message>
    <message>
        <source>noise rms</source>
        <translation>Rauschen rms</translation>
    </message>
    <message>
        <source>input</source>
        <translation>Eingang</translation>
    </message>
    <message>
        <source>largest step, at {time:.4g} s [1]</source>
        <translation>größter, {time:.4g} s [1]</translation>
    </message>
    <message>
        <source>since the step [ms]</source>
        <translation>seit dem Schritt [ms]</translation>
    </message>
    <message>
        <source>The input takes up to {ramp:.3g} ms from level to level, as fast as its limits allow: times count from where that begins, the model&apos;s too.</source>
        <translation>Der Eingang braucht bis zu {ramp:.3g} ms von Stufe zu Stufe, so schnell die Grenzen es erlauben: Zeiten zählen ab dessen Beginn, auch die des Modells.</translation>
    </message>
    <message>
        <source>rise</source>
        <translation>Anstieg</translation>
    </message>
    <message>
        <source>{name}: {n} of {steps} steps do not show it; they still move, or noise exceeds the band, at the end of their hold.</source>
        <translation>{name}: {n} von {steps} Schritten zeigen es nicht; am Ende der Haltezeit bewegen sie sich noch, oder das Rauschen überschreitet das Band.</translation>
    </message>
    <message>
        <source>{n} of {steps} steps are smaller than 10 times the noise about their level: overshoot and times are those of the noise; record larger steps.</source>
        <translation>{n} von {steps} Schritten sind kleiner als das 10-fache Rauschen: Überschwingen und Zeiten sind die des Rauschens; größere Schritte aufzeichnen.</translation>
    </message>
    <message>
        <source>median</source>
        <translation>Median</translation>
    </message>
    <message>
        <source>lowest</source>
        <translation>kleinster</translation>
    </message>
    <message>
        <source>highest</source>
        <translation>größter</translation>
    </message>
    <message>
        <source>Frequency response</source>
        <translation>Frequenzgang</translation>
    </message>
    <message>
        <source>Loop</source>
        <translation>Schleife</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>Schritte</translation>
    </message>
    <message>
        <source>Fitted model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Health card</source>
        <translation>Zustandskarte</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Identification</source>
        <translation>Identifikation</translation>
    </message>
</context>
</TS>
