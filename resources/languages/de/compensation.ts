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
        <source>Take off</source>
        <translation>Abnehmen</translation>
    </message>
    <message>
        <source>Put on</source>
        <translation>Anlegen</translation>
    </message>
    <message>
        <source>Take loop off</source>
        <translation>Abnehmen</translation>
    </message>
    <message>
        <source>it moves</source>
        <translation>sie bewegt sich</translation>
    </message>
    <message>
        <source>the robot has no piezo in open loop</source>
        <translation>der Roboter hat keinen Piezo im offenen Kreis</translation>
    </message>
    <message>
        <source>Close a loop of these gains around the axis, which stays in place, or open it</source>
        <translation>Einen Regelkreis mit diesen Verstärkungen um die Achse schließen, die stehen bleibt, oder ihn öffnen</translation>
    </message>
    <message>
        <source>Ends of moves, speeds and each row of a trajectory go through the inverse; the axis stays in place</source>
        <translation>Enden von Bewegungen, Geschwindigkeiten und jede Zeile einer Trajektorie gehen durch die Inverse; die Achse bleibt stehen</translation>
    </message>
    <message>
        <source>no inverse is on: put one on first</source>
        <translation>keine Inverse ist angelegt: zuerst eine anlegen</translation>
    </message>
    <message>
        <source>Play 6 s of swings over 60 % of the range</source>
        <translation>6 s Schwingungen über 60 % des Bereichs abspielen</translation>
    </message>
    <message>
        <source>Every set-point of this axis goes through the inverse; the axis stays in place</source>
        <translation>Jeder Sollwert dieser Achse geht durch die Inverse; die Achse bleibt stehen</translation>
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
        <source>Piezo axis in open loop that is compensated</source>
        <translation>Piezoachse im offenen Kreis, die kompensiert wird</translation>
    </message>
    <message>
        <source>Simulator</source>
        <translation>Simulator</translation>
    </message>
    <message>
        <source>Last record</source>
        <translation>Vorliegende</translation>
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
        <translation>Sichern …</translation>
    </message>
    <message>
        <source>Which inverse is put on</source>
        <translation>Welche Inverse angelegt wird</translation>
    </message>
    <message>
        <source>Which of the trained inverses is put on</source>
        <translation>Welche der gelernten Inversen angelegt wird</translation>
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
        <source>Keep …</source>
        <translation>Sichern …</translation>
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
        <source>Feed the reference forward through the inverse in hand</source>
        <translation>Die Referenz durch die vorliegende Inverse vorsteuern</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Halt</translation>
    </message>
    <message>
        <source>Learn from</source>
        <translation>Lernen aus</translation>
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
        <source>What is shown</source>
        <translation>Was gezeigt wird</translation>
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
        <source>Reading {name} …</source>
        <translation>{name} wird gelesen …</translation>
    </message>
    <message>
        <source>Saved {path}</source>
        <translation>Gespeichert: {path}</translation>
    </message>
    <message>
        <source>Writing {name} …</source>
        <translation>{name} wird geschrieben …</translation>
    </message>
    <message>
        <source>Stopped; nothing was replaced.</source>
        <translation>Abgebrochen; nichts wurde ersetzt.</translation>
    </message>
    <message>
        <source>Learning …</source>
        <translation>Lernen …</translation>
    </message>
    <message>
        <source>It failed; nothing was replaced.</source>
        <translation>Fehlgeschlagen; nichts wurde ersetzt.</translation>
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
        <source>work is under way; stop it or wait</source>
        <translation>eine Arbeit läuft; abbrechen oder warten</translation>
    </message>
    <message>
        <source>no record is in hand</source>
        <translation>keine Aufzeichnung liegt vor</translation>
    </message>
    <message>
        <source>Move the simulated axis over its range and learn from it</source>
        <translation>Die simulierte Achse über ihren Bereich bewegen und daraus lernen</translation>
    </message>
    <message>
        <source>Learn from the record in hand</source>
        <translation>Aus der vorliegenden Aufzeichnung lernen</translation>
    </message>
    <message>
        <source>Learn from records with cmd and meas, or ref</source>
        <translation>Aus Aufzeichnungen mit cmd und meas oder ref lernen</translation>
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
        <translation>Verstärkungen aus einer Datei von rotemina tune laden</translation>
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
        <source>Write the front with the point that is marked</source>
        <translation>Die Front mit dem markierten Punkt schreiben</translation>
    </message>
    <message>
        <source>nothing is under way</source>
        <translation>nichts läuft</translation>
    </message>
    <message>
        <source>End it</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>the inverse in hand is of axis {axis}</source>
        <translation>die vorliegende Inverse ist von Achse {axis}</translation>
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
        <source>Keep gains</source>
        <translation>Reglerparameter sichern</translation>
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
        <source>wanted</source>
        <translation>Soll</translation>
    </message>
    <message>
        <source>inverse of it</source>
        <translation>ihre Inverse</translation>
    </message>
    <message>
        <source>front</source>
        <translation>Front</translation>
    </message>
    <message>
        <source>Unseen, over the command [{unit}]</source>
        <translation>Ungesehen, über dem Sollwert [{unit}]</translation>
    </message>
    <message>
        <source>command [{unit}]</source>
        <translation>Sollwert [{unit}]</translation>
    </message>
    <message>
        <source>Residual of each inverse on unseen rows</source>
        <translation>Restfehler jeder Inverse auf ungesehenen Zeilen</translation>
    </message>
    <message>
        <source>Reading over reference [{unit}]</source>
        <translation>Messwert über Sollwert [{unit}]</translation>
    </message>
    <message>
        <source>reference [{unit}]</source>
        <translation>Sollwert [{unit}]</translation>
    </message>
    <message>
        <source>Reading − reference, mean removed [{unit}]</source>
        <translation>Messwert − Sollwert, ohne Mittelwert [{unit}]</translation>
    </message>
    <message>
        <source>Effort [ranges/s] over tracking [%]</source>
        <translation>Aufwand [Bereiche/s] über Folgefehler [%]</translation>
    </message>
    <message>
        <source>tracking rms [%]</source>
        <translation>Folgefehler rms [%]</translation>
    </message>
    <message>
        <source>Click a point: its step and triangle are tried at once</source>
        <translation>Einen Punkt anklicken: sein Sprung und sein Dreieck werden sofort getestet</translation>
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
        <source>There is no inverse yet: learn one, or open a file.</source>
        <translation>Es gibt noch keine Inverse: eine lernen oder eine Datei öffnen.</translation>
    </message>
    <message>
        <source>there is no front yet: tune, or open gains</source>
        <translation>es gibt noch keine Front: abstimmen oder Reglerparameter öffnen</translation>
    </message>
    <message>
        <source>The simulated machine closes the loop live, at 5 kHz; it is put on only where it is stable on axes off by 5 % too. The boards close none: there, what is put on is feed-forward.</source>
        <translation>Die simulierte Maschine schließt den Regelkreis live, bei 5 kHz; er wird nur angelegt, wo er auch bei Achsen mit 5 % Abweichung stabil ist. Die Steuerkarten schließen keinen: dort ist, was angelegt wird, Vorsteuerung.</translation>
    </message>
    <message>
        <source>Its loop asks for more than the axis&apos; range: move it away from the end.</source>
        <translation>Der Regelkreis verlangt mehr als den Bereich der Achse: sie vom Ende wegbewegen.</translation>
    </message>
    <message>
        <source>Sweep the whole range of the inverse to erase the history of the axis: this removes most of a constant error (a loop removes it anyway)</source>
        <translation>Den ganzen Bereich der Inverse durchfahren, um die Vorgeschichte der Achse zu löschen: das beseitigt den größten Teil eines konstanten Fehlers (ein Regelkreis beseitigt ihn ohnehin)</translation>
    </message>
    <message>
        <source>Apply gains</source>
        <translation>Regler anlegen</translation>
    </message>
    <message>
        <source>below its trained range (clamped)</source>
        <translation>unter dem gelernten Bereich (begrenzt)</translation>
    </message>
    <message>
        <source>above its trained range (clamped)</source>
        <translation>über dem gelernten Bereich (begrenzt)</translation>
    </message>
    <message>
        <source>faster than it was trained</source>
        <translation>schneller als gelernt</translation>
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
        <source>axis {axis} is still driven by {owner}; wait, or stop it</source>
        <translation>Achse {axis} wird noch von {owner} bewegt; warten oder anhalten</translation>
    </message>
    <message>
        <source>It has been {where}.</source>
        <translation>Sie war {where}.</translation>
    </message>
    <message>
        <source>Point {number}: tracking {tracking:.3g} %, settling {settling:.3g} ms, overshoot {overshoot:.2g} %, Ms {peak:.2f}</source>
        <translation>Punkt {number}: Folgefehler {tracking:.3g} %, Einschwingzeit {settling:.3g} ms, Überschwingen {overshoot:.2g} %, Ms {peak:.2f}</translation>
    </message>
    <message>
        <source>0 to {most}; held against the axis before it acts</source>
        <translation>0 bis {most}; wird an der Achse geprüft, bevor es wirkt</translation>
    </message>
    <message>
        <source>gain {letter} = {text}: must be a number from 0 to {most}, the greatest that a search tries</source>
        <translation>Verstärkung {letter} = {text}: muss eine Zahl von 0 bis {most} sein, dem Größten, was eine Suche versucht</translation>
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
