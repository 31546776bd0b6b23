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
        <source>Excite</source>
        <translation>Anregen</translation>
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
        <source>{n} averages</source>
        <translation>{n} Mittel</translation>
    </message>
    <message>
        <source>Averages</source>
        <translation>Mittelungen</translation>
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
        <translation>Speichern …</translation>
    </message>
    <message>
        <source>Copy the figures as text</source>
        <translation>Die Kennwerte als Text kopieren</translation>
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
        <source>Amplitude of the excitation</source>
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
        <source>Time of the excitation</source>
        <translation>Zeit der Anregung</translation>
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
        <source>{axis}: free</source>
        <translation>{axis}: frei</translation>
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
        <source>Motion of the excitation</source>
        <translation>Bewegung der Anregung</translation>
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
        <source>The leading pole is real: the record shows a lag, no resonance.</source>
        <translation>Der führende Pol ist reell: die Aufzeichnung zeigt eine Verzögerung, keine Resonanz.</translation>
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
        <source>median coherence</source>
        <translation>Median der Kohärenz</translation>
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
        <translation>Anpassungsfehler der Eigenform</translation>
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
        <source>Last card: {date}, the latest of {n}. Changed beyond both intervals: {figures}.</source>
        <translation>Letzte Karte: {date}, die neueste von {n}. Über beide Intervalle hinaus geändert: {figures}.</translation>
    </message>
    <message>
        <source>Last card: {date}, the latest of {n}. No figure has changed beyond both intervals.</source>
        <translation>Letzte Karte: {date}, die neueste von {n}. Kein Kennwert hat sich über beide Intervalle hinaus geändert.</translation>
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
        <source>width over stroke</source>
        <translation>Breite je Hub</translation>
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
        <source>Records (*.csv *.txt *.dat *.gz);;All files (*)</source>
        <translation>Aufzeichnungen (*.csv *.txt *.dat *.gz);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Figures</source>
        <translation>Kennwerte</translation>
    </message>
    <message>
        <source>Open record</source>
        <translation>Aufzeichnung öffnen</translation>
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
        <source>there are no figures yet</source>
        <translation>es gibt noch keine Zahlen</translation>
    </message>
    <message>
        <source>Write the figures to a file</source>
        <translation>Die Kennwerte in eine Datei schreiben</translation>
    </message>
    <message>
        <source>Save results</source>
        <translation>Ergebnisse speichern</translation>
    </message>
    <message>
        <source>Tables (*.csv)</source>
        <translation>Tabellen (*.csv)</translation>
    </message>
    <message>
        <source>{axis}: the record has no {axis}.{tap}; it has {columns}</source>
        <translation>{axis}: die Aufzeichnung hat kein {axis}.{tap}; sie hat {columns}</translation>
    </message>
    <message>
        <source>steps</source>
        <translation>Sprünge</translation>
    </message>
    <message>
        <source>size of the step</source>
        <translation>Sprunghöhe</translation>
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
        <source>largest step, at {time:.4g} s [normalised]</source>
        <translation>größter Sprung, bei {time:.4g} s [normiert]</translation>
    </message>
    <message>
        <source>{n} of {steps} steps are smaller than 10 times the noise, so noise dominates overshoot and times. Record larger steps.</source>
        <translation>{n} von {steps} Sprüngen sind kleiner als das Zehnfache des Rauschens; das Rauschen bestimmt dann Überschwingen und Zeiten. Größere Sprünge aufzeichnen.</translation>
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
        <source>rise</source>
        <translation>Anstieg</translation>
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
        <translation>Sprünge</translation>
    </message>
    <message>
        <source>Fitted model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Health card</source>
        <translation>Zustandskarte</translation>
    </message>
    <message>
        <source>Computing the motion and checking it on the model …</source>
        <translation>Die Bewegung wird berechnet und am Modell geprüft …</translation>
    </message>
    <message>
        <source>Amplitude each way from the middle, such as 5um, 200urad or 30% of the range; a value beyond a limit is reduced, with a notice</source>
        <translation>Amplitude nach beiden Seiten der Mitte, etwa 5um, 200urad oder 30% des Bereichs; ein Wert jenseits einer Grenze wird verringert und gemeldet</translation>
    </message>
    <message>
        <source>Frequency, above 0 Hz; the highest one of a multisine</source>
        <translation>Frequenz über 0 Hz; bei einem Multisinus die höchste</translation>
    </message>
    <message>
        <source>Duration, above 0 s; the rest on each level of a staircase</source>
        <translation>Dauer über 0 s; bei einer Treppe die Ruhe auf jeder Stufe</translation>
    </message>
    <message>
        <source>around here</source>
        <translation>um hier</translation>
    </message>
    <message>
        <source>Move around the present position; off: around the middle of the range</source>
        <translation>Um die aktuelle Position bewegen; aus: um die Mitte des Bereichs</translation>
    </message>
    <message>
        <source>Play the motion and analyse the record</source>
        <translation>Die Bewegung abspielen und die Aufzeichnung auswerten</translation>
    </message>
    <message>
        <source>Stop the machine and end the motion</source>
        <translation>Die Maschine anhalten und die Bewegung beenden</translation>
    </message>
    <message>
        <source>{axis}: controlled by {driver}</source>
        <translation>{axis}: gesteuert von {driver}</translation>
    </message>
    <message>
        <source>Waits until the dry run has ended …</source>
        <translation>Wartet auf das Ende des Probelaufs …</translation>
    </message>
    <message>
        <source>it waits until the dry run has ended</source>
        <translation>es wartet auf das Ende des Probelaufs</translation>
    </message>
    <message>
        <source>the axes are still moving</source>
        <translation>die Achsen bewegen sich noch</translation>
    </message>
    <message>
        <source>Axis to be excited; the others stay at rest</source>
        <translation>Anzuregende Achse; die anderen bleiben in Ruhe</translation>
    </message>
    <message>
        <source>Motion of the excitation; the help (F1) describes what each one shows</source>
        <translation>Bewegung der Anregung; was jede zeigt, steht in der Hilfe (F1)</translation>
    </message>
    <message>
        <source>the motion is not playing</source>
        <translation>die Bewegung wird nicht abgespielt</translation>
    </message>
    <message>
        <source>{tip}; empty: a value that suits the axis</source>
        <translation>{tip}; leer: ein passender Wert</translation>
    </message>
    <message>
        <source>Reduced to the limits: {change}.</source>
        <translation>An die Grenzen angepasst: {change}.</translation>
    </message>
    <message>
        <source>Dry run: within all limits and the bounds of the tip.</source>
        <translation>Probelauf: innerhalb aller Grenzen, auch der Spitze.</translation>
    </message>
    <message>
        <source>Excite an axis, play a trajectory or open a record to identify the machine.</source>
        <translation>Eine Achse anregen, eine Trajektorie abspielen oder eine Aufzeichnung öffnen, um die Maschine zu identifizieren.</translation>
    </message>
    <message>
        <source>these figures are not a health card</source>
        <translation>diese Zahlen sind keine Zustandskarte</translation>
    </message>
    <message>
        <source>Stored the health card of {axis}</source>
        <translation>Zustandskarte von {axis} gespeichert</translation>
    </message>
    <message>
        <source>Limits of this record</source>
        <translation>Grenzen dieser Aufzeichnung</translation>
    </message>
    <message>
        <source>Storing the health card …</source>
        <translation>Zustandskarte wird gespeichert …</translation>
    </message>
    <message>
        <source>{record}: axis {axis} lacks an input or an output.</source>
        <translation>{record}: der Achse {axis} fehlt ein Eingang oder ein Ausgang.</translation>
    </message>
    <message>
        <source>The fitted model is unstable: it describes noise or drift. Choose the method output error.</source>
        <translation>Das angepasste Modell ist instabil: es beschreibt Rauschen oder Drift. Das Verfahren OE (Ausgangsfehler) wählen.</translation>
    </message>
    <message>
        <source>The fit uses the first {n} of {rows} rows, to save time.</source>
        <translation>Die Anpassung benutzt die ersten {n} von {rows} Zeilen, um Zeit zu sparen.</translation>
    </message>
    <message>
        <source>fit one step ahead</source>
        <translation>Anpassung einen Schritt voraus</translation>
    </message>
    <message>
        <source>The model fits {ahead:.1f} % one step ahead but {fit:.1f} % in simulation: sensor noise biases ARX. Choose the method output error.</source>
        <translation>Das Modell passt einen Schritt voraus zu {ahead:.1f} %, in der Simulation aber zu {fit:.1f} %: Sensorrauschen verfälscht ARX. Das Verfahren OE (Ausgangsfehler) wählen.</translation>
    </message>
    <message>
        <source>{mode:.4g} Hz is above {highest:.4g} Hz, {share:g} of half the sampling rate: it is a delay or noise, not a mode of the machine.</source>
        <translation>{mode:.4g} Hz liegt über {highest:.4g} Hz, dem {share:g}-Fachen der halben Abtastrate: es ist eine Totzeit oder Rauschen, keine Eigenform der Maschine.</translation>
    </message>
    <message>
        <source>The fit of {fit:.1f} % is below {bound:g} %: noise, distortion, another axis or too few poles. Frequency and damping are not those of the machine.</source>
        <translation>Die Anpassung von {fit:.1f} % liegt unter {bound:g} %: Rauschen, Verzerrung, eine andere Achse oder zu wenige Pole. Frequenz und Dämpfung sind nicht die der Maschine.</translation>
    </message>
    <message>
        <source>The frequency is uncertain by {deviation:.2g} Hz, more than {rough:.0f} %: the record hardly excites the mode. Use faster steps or a multisine.</source>
        <translation>Die Frequenz ist um {deviation:.2g} Hz unsicher, mehr als {rough:.0f} %: die Aufzeichnung regt die Eigenform kaum an. Schnellere Sprünge oder einen Multisinus verwenden.</translation>
    </message>
    <message>
        <source>program error: {kind}: {error}</source>
        <translation>Programmfehler: {kind}: {error}</translation>
    </message>
    <message>
        <source>at frequency</source>
        <translation>bei Frequenz</translation>
    </message>
    <message>
        <source>time of the step</source>
        <translation>Zeitpunkt des Sprungs</translation>
    </message>
    <message>
        <source>The input excites only {n} lines, up to {highest:.4g} Hz ({wanted} lines are needed). Record a multisine or a chirp to see higher frequencies.</source>
        <translation>Der Eingang regt nur {n} Linien an, bis {highest:.4g} Hz ({wanted} sind nötig). Einen Multisinus oder Chirp aufzeichnen, um höhere Frequenzen zu sehen.</translation>
    </message>
    <message>
        <source>The coherence is below {bound:g} on {n} of {lines} lines: noise, distortion, another axis or leakage. The interval is wide there.</source>
        <translation>Die Kohärenz liegt bei {n} von {lines} Linien unter {bound:g}: Rauschen, Verzerrung, eine andere Achse oder Leckeffekt. Dort ist das Intervall breit.</translation>
    </message>
    <message>
        <source>frequency response: {averages} averages of {n} samples give segments of {segment} samples; at least {least} are needed. Record longer or average less.</source>
        <translation>Frequenzgang: {averages} Mittelungen von {n} Abtastungen ergeben Segmente zu {segment}; mindestens {least} sind nötig. Länger aufzeichnen oder weniger mitteln.</translation>
    </message>
    <message>
        <source>The resonance is {width:.3g} Hz wide, less than {lines} lines of {resolution:.3g} Hz: it appears flatter than it is. Average less or record longer.</source>
        <translation>Die Resonanz ist {width:.3g} Hz breit, weniger als {lines} Linien zu {resolution:.3g} Hz: sie erscheint flacher, als sie ist. Weniger mitteln oder länger aufzeichnen.</translation>
    </message>
    <message>
        <source>A single mode misses the peak by {misfit:.0f} % (bound {bound:.0f} %): there may be two modes, and the damping is inaccurate.</source>
        <translation>Eine einzelne Eigenform verfehlt die Spitze um {misfit:.0f} % (Grenze {bound:.0f} %): es können zwei sein, und die Dämpfung ist ungenau.</translation>
    </message>
    <message>
        <source>The nominal model is not shown: {reason}</source>
        <translation>Das nominale Modell fehlt: {reason}</translation>
    </message>
    <message>
        <source>width at mid-range</source>
        <translation>Breite in der Mitte</translation>
    </message>
    <message>
        <source>deviation from a straight line</source>
        <translation>Abweichung von einer Geraden</translation>
    </message>
    <message>
        <source>backlash width</source>
        <translation>Breite des Spiels</translation>
    </message>
    <message>
        <source>too similar</source>
        <translation>zu ähnlich</translation>
    </message>
    <message>
        <source>The figures use the first {n} of {rows} rows, with {turns} reversals: the input is noise, or very long.</source>
        <translation>Die Kennwerte benutzen die ersten {n} von {rows} Zeilen mit {turns} Umkehrungen: der Eingang ist Rauschen oder sehr lang.</translation>
    </message>
    <message>
        <source>The plot shows the first {n} of {rows} rows; the figures use all rows.</source>
        <translation>Das Diagramm zeigt die ersten {n} von {rows} Zeilen; die Kennwerte benutzen alle.</translation>
    </message>
    <message>
        <source>A cycle has {rows:.0f} rows, fewer than {least}: lag and resonance cause the loop. Drive slower cycles.</source>
        <translation>Ein Zyklus hat {rows:.0f} Zeilen, weniger als {least}: Verzögerung und Resonanz verursachen die Schleife. Langsamere Zyklen fahren.</translation>
    </message>
    <message>
        <source>The width is negative: the output leads the input.</source>
        <translation>Die Breite ist negativ: der Ausgang eilt dem Eingang vor.</translation>
    </message>
    <message>
        <source>The width is negative: the output leads, or the axis lags less than the {lag} sample subtracted for a stepwise command. Drive slower cycles.</source>
        <translation>Die Breite ist negativ: der Ausgang eilt vor, oder die Achse verzögert weniger als die {lag} Abtastung, die für einen stufenförmigen Sollwert abgezogen wird. Langsamere Zyklen fahren.</translation>
    </message>
    <message>
        <source>time since the step [ms]</source>
        <translation>Zeit seit dem Sprung [ms]</translation>
    </message>
    <message>
        <source>The input takes up to {ramp:.3g} ms from level to level, as fast as its limits allow. All times count from the start of that ramp, for the model too.</source>
        <translation>Der Eingang braucht bis zu {ramp:.3g} ms von Stufe zu Stufe, so schnell die Grenzen es erlauben. Alle Zeiten zählen ab Beginn dieser Rampe, auch die des Modells.</translation>
    </message>
    <message>
        <source>{name}: {n} of {steps} steps give no value; at the end of the hold the axis still moves, or noise exceeds the band.</source>
        <translation>{name}: {n} von {steps} Sprüngen ergeben keinen Wert; am Ende der Haltezeit bewegt sich die Achse noch, oder das Rauschen überschreitet das Band.</translation>
    </message>
    <message>
        <source>There is no card of this axis yet. Store this one to compare with it later.</source>
        <translation>Von dieser Achse gibt es noch keine Karte. Diese speichern, um später mit ihr zu vergleichen.</translation>
    </message>
    <message>
        <source>Open a record for this page only</source>
        <translation>Eine Aufzeichnung nur für diese Seite öffnen</translation>
    </message>
    <message>
        <source>Choose a motion that excites an axis, play it and analyse the record</source>
        <translation>Eine Bewegung wählen, die eine Achse anregt, sie abspielen und die Aufzeichnung auswerten</translation>
    </message>
    <message>
        <source>Analysis</source>
        <translation>Auswertung</translation>
    </message>
    <message>
        <source>Segments of Welch&apos;s method: more segments smooth the curve, fewer resolve narrower peaks. A periodic record is averaged over its periods instead.</source>
        <translation>Segmente nach Welch: mehr Segmente glätten die Kurve, weniger lösen schmalere Spitzen auf. Eine periodische Aufzeichnung wird stattdessen über ihre Perioden gemittelt.</translation>
    </message>
    <message>
        <source>Store card</source>
        <translation>Karte speichern</translation>
    </message>
    <message>
        <source>Store this health card with the earlier ones of the axis</source>
        <translation>Diese Zustandskarte zu den früheren der Achse speichern</translation>
    </message>
    <message>
        <source>{axis}: input and output are both {tap}; choose two different signals</source>
        <translation>{axis}: Eingang und Ausgang sind beide {tap}; zwei verschiedene Signale wählen</translation>
    </message>
    <message>
        <source>{name}: {text} is not a number in {unit}; enter a value such as 2.5 {unit}, or leave the field empty</source>
        <translation>{name}: {text} ist keine Zahl in {unit}; einen Wert wie 2,5 {unit} eingeben oder das Feld leer lassen</translation>
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
