<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>compensation</name>
    <message>
        <source>Checking the loop …</source>
        <translation>Regelkreis wird geprüft …</translation>
    </message>
    <message>
        <source>the robot has no piezo in open loop</source>
        <translation>der Roboter hat keinen Piezo im offenen Kreis</translation>
    </message>
    <message>
        <source>Without</source>
        <translation>Ohne</translation>
    </message>
    <message>
        <source>Inverse</source>
        <translation>Inverse</translation>
    </message>
    <message>
        <source>Feedback</source>
        <translation>Regelung</translation>
    </message>
    <message>
        <source>Both</source>
        <translation>Beide</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>Simulator</source>
        <translation>Simulator</translation>
    </message>
    <message>
        <source>Last record</source>
        <translation>Letzte</translation>
    </message>
    <message>
        <source>Records …</source>
        <translation>Dateien …</translation>
    </message>
    <message>
        <source>Open …</source>
        <translation>Öffnen …</translation>
    </message>
    <message>
        <source>Save …</source>
        <translation>Speichern …</translation>
    </message>
    <message>
        <source>Try it</source>
        <translation>Testen</translation>
    </message>
    <message>
        <source>Sweep</source>
        <translation>Durchlauf</translation>
    </message>
    <message>
        <source>Tune</source>
        <translation>Abstimmen</translation>
    </message>
    <message>
        <source>Generations of 60 individuals</source>
        <translation>Generationen zu 60 Individuen</translation>
    </message>
    <message>
        <source>1 to 500 generations of 60 individuals each</source>
        <translation>1 bis 500 Generationen zu je 60 Individuen</translation>
    </message>
    <message>
        <source>through the inverse</source>
        <translation>durch die Inverse</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Halt</translation>
    </message>
    <message>
        <source>Feed-forward</source>
        <translation>Vorsteuerung</translation>
    </message>
    <message>
        <source>Remaining error of a trial</source>
        <translation>Restfehler eines Versuchs</translation>
    </message>
    <message>
        <source>moving the simulated axis</source>
        <translation>die simulierte Achse wird bewegt</translation>
    </message>
    <message>
        <source>Records (*.csv *.txt *.dat *.gz);;All files (*)</source>
        <translation>Aufzeichnungen (*.csv *.txt *.dat *.gz);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Inverses (*.json)</source>
        <translation>Inverse (*.json)</translation>
    </message>
    <message>
        <source>Tunings (*.toml)</source>
        <translation>Abstimmungen (*.toml)</translation>
    </message>
    <message>
        <source>Check</source>
        <translation>Prüfung</translation>
    </message>
    <message>
        <source>Live</source>
        <translation>Live</translation>
    </message>
    <message>
        <source>Tuning</source>
        <translation>Abstimmung</translation>
    </message>
    <message>
        <source>Stopped; nothing was replaced.</source>
        <translation>Abgebrochen; nichts wurde ersetzt.</translation>
    </message>
    <message>
        <source>Compensation: {message}</source>
        <translation>Kompensation: {message}</translation>
    </message>
    <message>
        <source>{inverse} (recommended)</source>
        <translation>{inverse} (empfohlen)</translation>
    </message>
    <message>
        <source>Load inverses from a file</source>
        <translation>Inverse aus einer Datei laden</translation>
    </message>
    <message>
        <source>Save these inverses to a file</source>
        <translation>Diese Inversen in einer Datei speichern</translation>
    </message>
    <message>
        <source>Load gains from a file that rotemina tune wrote</source>
        <translation>Reglerparameter aus einer Datei von rotemina tune laden</translation>
    </message>
    <message>
        <source>Save inverses</source>
        <translation>Inverse speichern</translation>
    </message>
    <message>
        <source>Search gains of a PID loop at 5 kHz on the simulated axis</source>
        <translation>Reglerparameter eines PID-Kreises bei 5 kHz an der simulierten Achse suchen</translation>
    </message>
    <message>
        <source>Records</source>
        <translation>Aufzeichnungen</translation>
    </message>
    <message>
        <source>Inverses</source>
        <translation>Inverse</translation>
    </message>
    <message>
        <source>Gains</source>
        <translation>Reglerparameter</translation>
    </message>
    <message>
        <source>Preparing the simulated loop</source>
        <translation>Der simulierte Regelkreis wird vorbereitet</translation>
    </message>
    <message>
        <source>{done} of {total} generations, {points} points</source>
        <translation>{done} von {total} Generationen, {points} Punkte</translation>
    </message>
    <message>
        <source>without</source>
        <translation>ohne</translation>
    </message>
    <message>
        <source>with the inverse</source>
        <translation>mit Inverse</translation>
    </message>
    <message>
        <source>with feedback</source>
        <translation>mit Regelung</translation>
    </message>
    <message>
        <source>with both</source>
        <translation>mit beiden</translation>
    </message>
    <message>
        <source>position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>front</source>
        <translation>Front</translation>
    </message>
    <message>
        <source>inverse model</source>
        <translation>inverses Modell</translation>
    </message>
    <message>
        <source>Validation data against the command [{unit}]</source>
        <translation>Prüfdaten über dem Sollwert [{unit}]</translation>
    </message>
    <message>
        <source>command [{unit}]</source>
        <translation>Sollwert [{unit}]</translation>
    </message>
    <message>
        <source>Control effort [ranges/s] against tracking error [%]</source>
        <translation>Stellaufwand [Bereiche/s] über Folgefehler [%]</translation>
    </message>
    <message>
        <source>rms tracking error [%]</source>
        <translation>Folgefehler rms [%]</translation>
    </message>
    <message>
        <source>Click a point to simulate its step and triangle responses</source>
        <translation>Einen Punkt anklicken, um seine Sprung- und Dreieckantwort zu simulieren</translation>
    </message>
    <message>
        <source>reference [{unit}]</source>
        <translation>Sollwert [{unit}]</translation>
    </message>
    <message>
        <source>Reading against reference [{unit}]</source>
        <translation>Messwert über Sollwert [{unit}]</translation>
    </message>
    <message>
        <source>Reading − reference, mean removed [{unit}]</source>
        <translation>Messwert − Sollwert, ohne Mittelwert [{unit}]</translation>
    </message>
    <message>
        <source>Pareto front</source>
        <translation>Pareto-Front</translation>
    </message>
    <message>
        <source>Step [{unit}]</source>
        <translation>Sprung [{unit}]</translation>
    </message>
    <message>
        <source>time [ms]</source>
        <translation>Zeit [ms]</translation>
    </message>
    <message>
        <source>Triangle [{unit}]</source>
        <translation>Dreieck [{unit}]</translation>
    </message>
    <message>
        <source>inverse</source>
        <translation>Inverse</translation>
    </message>
    <message>
        <source>rms</source>
        <translation>rms</translation>
    </message>
    <message>
        <source>worst</source>
        <translation>größter</translation>
    </message>
    <message>
        <source>of range</source>
        <translation>vom Bereich</translation>
    </message>
    <message>
        <source>Sweep the whole range of the inverse to erase the history of the axis: this removes most of a constant error (a loop removes it anyway)</source>
        <translation>Den ganzen Bereich der Inverse durchfahren, um die Vorgeschichte der Achse zu löschen: das beseitigt den größten Teil eines konstanten Fehlers (ein Regelkreis beseitigt ihn ohnehin)</translation>
    </message>
    <message>
        <source>Apply gains</source>
        <translation>Anwenden</translation>
    </message>
    <message>
        <source>at an end of the machine&apos;s range (clamped)</source>
        <translation>an einem Ende des Maschinenbereichs (begrenzt)</translation>
    </message>
    <message>
        <source>{rms} rms, mean {mean}</source>
        <translation>{rms} rms, Mittel {mean}</translation>
    </message>
    <message>
        <source>Point {number}: tracking {tracking:.3g} %, settling {settling:.3g} ms, overshoot {overshoot:.2g} %, Ms {peak:.2f}</source>
        <translation>Punkt {number}: Folgefehler {tracking:.3g} %, Einschwingzeit {settling:.3g} ms, Überschwingen {overshoot:.2g} %, Ms {peak:.2f}</translation>
    </message>
    <message>
        <source>0 to {most}; checked on the axis before use</source>
        <translation>0 bis {most}; wird vor der Anwendung an der Achse geprüft</translation>
    </message>
    <message>
        <source>gain {letter} = {text}: must be a number from 0 to {most}, the bound of the search</source>
        <translation>Verstärkung {letter} = {text}: muss eine Zahl von 0 bis {most} sein, der Grenze der Suche</translation>
    </message>
    <message>
        <source>There is no inverse: train one, or open a file.</source>
        <translation>Es gibt keine Inverse: eine trainieren oder eine Datei öffnen.</translation>
    </message>
    <message>
        <source>there is no front: tune, or open gains</source>
        <translation>es gibt keine Front: abstimmen oder Reglerparameter öffnen</translation>
    </message>
    <message>
        <source>The simulated machine closes the loop live at 5 kHz, only if it is also stable on axes off by 5 %. The boards close no loop: there, only feed-forward is possible.</source>
        <translation>Die simulierte Maschine schließt den Regelkreis live bei 5 kHz, nur wenn er auch bei Achsen mit 5 % Abweichung stabil ist. Die Steuerkarten schließen keinen: dort ist nur Vorsteuerung möglich.</translation>
    </message>
    <message>
        <source>The loop demands more than the range of the axis: move the axis away from the end.</source>
        <translation>Der Regelkreis verlangt mehr als den Bereich der Achse: die Achse vom Ende wegbewegen.</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Anwenden</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Abschalten</translation>
    </message>
    <message>
        <source>Open loop</source>
        <translation>Kreis öffnen</translation>
    </message>
    <message>
        <source>below its training range (clamped)</source>
        <translation>unter dem trainierten Bereich (begrenzt)</translation>
    </message>
    <message>
        <source>above its training range (clamped)</source>
        <translation>über dem trainierten Bereich (begrenzt)</translation>
    </message>
    <message>
        <source>faster than in training</source>
        <translation>schneller als im Training</translation>
    </message>
    <message>
        <source>The axis has been {where}.</source>
        <translation>Die Achse war {where}.</translation>
    </message>
    <message>
        <source>{owner} still controls axis {axis}; wait, or stop it</source>
        <translation>{owner} steuert noch Achse {axis}; warten oder anhalten</translation>
    </message>
    <message>
        <source>Close a loop with these gains around the axis, or open it; the axis stays in place</source>
        <translation>Mit diesen Reglerparametern einen Regelkreis um die Achse schließen oder ihn öffnen; die Achse bleibt stehen</translation>
    </message>
    <message>
        <source>Apply the inverse to ends of moves, speeds and each row of a trajectory; the axis stays in place</source>
        <translation>Die Inverse auf Endpunkte von Bewegungen, Geschwindigkeiten und jede Zeile einer Trajektorie anwenden; die Achse bleibt stehen</translation>
    </message>
    <message>
        <source>the axis is moving</source>
        <translation>die Achse bewegt sich</translation>
    </message>
    <message>
        <source>Not played: {why}. Press the button again.</source>
        <translation>Nicht abgespielt: {why}. Noch einmal auf die Taste drücken.</translation>
    </message>
    <message>
        <source>Nothing is applied: no inverse of {axis} is trained. Train one first.</source>
        <translation>Nichts wird angewendet: für {axis} ist keine Inverse trainiert. Erst eine trainieren.</translation>
    </message>
    <message>
        <source>no inverse is active: apply one first</source>
        <translation>keine Inverse ist aktiv: zuerst eine anwenden</translation>
    </message>
    <message>
        <source>Play 6 s of oscillations over 60 % of the range</source>
        <translation>6 s Schwingungen über 60 % des Bereichs abspielen</translation>
    </message>
    <message>
        <source>Apply the inverse to every set-point of this axis; the axis stays in place</source>
        <translation>Die Inverse auf jeden Sollwert dieser Achse anwenden; die Achse bleibt stehen</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>Training …</source>
        <translation>Training …</translation>
    </message>
    <message>
        <source>Failed; nothing was replaced.</source>
        <translation>Fehlgeschlagen; nichts wurde ersetzt.</translation>
    </message>
    <message>
        <source>work is in progress; stop it or wait</source>
        <translation>eine Berechnung läuft; abbrechen oder warten</translation>
    </message>
    <message>
        <source>there is no record</source>
        <translation>es gibt keine Aufzeichnung</translation>
    </message>
    <message>
        <source>Train with a motion of the simulated axis over its range</source>
        <translation>Mit einer Bewegung der simulierten Achse über ihren Bereich trainieren</translation>
    </message>
    <message>
        <source>Train with the last record</source>
        <translation>Mit der letzten Aufzeichnung trainieren</translation>
    </message>
    <message>
        <source>Train with records that have cmd and meas or ref</source>
        <translation>Mit Aufzeichnungen trainieren, die cmd und meas oder ref haben</translation>
    </message>
    <message>
        <source>Feed the reference forward through the current inverse</source>
        <translation>Den Sollwert durch die aktuelle Inverse vorsteuern</translation>
    </message>
    <message>
        <source>Save the front with the selected point</source>
        <translation>Die Front mit dem gewählten Punkt speichern</translation>
    </message>
    <message>
        <source>Stop the work</source>
        <translation>Die laufende Berechnung abbrechen</translation>
    </message>
    <message>
        <source>Save gains</source>
        <translation>Reglerparameter speichern</translation>
    </message>
    <message>
        <source>nothing is running</source>
        <translation>nichts läuft</translation>
    </message>
    <message>
        <source>the current inverse belongs to axis {axis}</source>
        <translation>die aktuelle Inverse gehört zu Achse {axis}</translation>
    </message>
    <message>
        <source>desired</source>
        <translation>Soll</translation>
    </message>
    <message>
        <source>Residual of each inverse on validation rows</source>
        <translation>Restfehler jeder Inversen auf Prüfzeilen</translation>
    </message>
    <message>
        <source>Piezo axis in open loop to be compensated</source>
        <translation>Piezoachse im offenen Kreis, die kompensiert wird</translation>
    </message>
    <message>
        <source>Inverse to apply</source>
        <translation>Anzuwendende Inverse</translation>
    </message>
    <message>
        <source>Trained inverse to apply</source>
        <translation>Anzuwendende trainierte Inverse</translation>
    </message>
    <message>
        <source>Save gains …</source>
        <translation>Sichern …</translation>
    </message>
    <message>
        <source>Train with</source>
        <translation>Training mit</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Compensation</source>
        <translation>Kompensation</translation>
    </message>
</context>
</TS>
