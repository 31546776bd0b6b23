<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>calibration</name>
    <message>
        <source>Not run: {why}. Press Run again.</source>
        <translation>Nicht gestartet: {why}. Noch einmal auf Starten drücken.</translation>
    </message>
    <message>
        <source>Records (*.csv *.txt *.dat *.gz);;All files (*)</source>
        <translation>Aufzeichnungen (*.csv *.txt *.dat *.gz);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>Stored</source>
        <translation>Gespeichert</translation>
    </message>
    <message>
        <source>Planning …</source>
        <translation>Planung …</translation>
    </message>
    <message>
        <source>Calibration of {axis} in use: {path}</source>
        <translation>Verwendete Kalibrierung von {axis}: {path}</translation>
    </message>
    <message>
        <source>Storing the calibration …</source>
        <translation>Kalibrierung wird gespeichert …</translation>
    </message>
    <message>
        <source>Switching the calibration …</source>
        <translation>Kalibrierung wird umgeschaltet …</translation>
    </message>
    <message>
        <source>Calibration: {message}.</source>
        <translation>Kalibrierung: {message}.</translation>
    </message>
    <message>
        <source>Fitting the sensor …</source>
        <translation>Sensor wird angepasst …</translation>
    </message>
    <message>
        <source>Stored ({n})</source>
        <translation>Gespeichert ({n})</translation>
    </message>
    <message>
        <source>Reading calibrations …</source>
        <translation>Kalibrierungen werden gelesen …</translation>
    </message>
    <message>
        <source>Records with sensor and laser</source>
        <translation>Aufzeichnungen mit Sensor und Laser</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>Axis whose sensor is calibrated</source>
        <translation>Achse, deren Sensor kalibriert wird</translation>
    </message>
    <message>
        <source>Runs</source>
        <translation>Läufe</translation>
    </message>
    <message>
        <source>Targets</source>
        <translation>Ziele</translation>
    </message>
    <message>
        <source>the laser&apos;s zero is the axis&apos; zero</source>
        <translation>der Nullpunkt des Lasers ist der der Achse</translation>
    </message>
    <message>
        <source>Plan</source>
        <translation>Planen</translation>
    </message>
    <message>
        <source>Run</source>
        <translation>Starten</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Halt</translation>
    </message>
    <message>
        <source>Fit records …</source>
        <translation>Anpassen …</translation>
    </message>
    <message>
        <source>Stop the machine now</source>
        <translation>Die Maschine jetzt anhalten</translation>
    </message>
    <message>
        <source>there is no plan yet</source>
        <translation>es gibt noch keinen Plan</translation>
    </message>
    <message>
        <source>the machine is still moving</source>
        <translation>die Maschine bewegt sich noch</translation>
    </message>
    <message>
        <source>Figures of the sensor</source>
        <translation>Kennwerte des Sensors</translation>
    </message>
    <message>
        <source>Figures of ISO 230-2</source>
        <translation>Kennwerte nach ISO 230-2</translation>
    </message>
    <message>
        <source>Store and use</source>
        <translation>Speichern und nutzen</translation>
    </message>
    <message>
        <source>there is no result yet</source>
        <translation>es gibt noch kein Ergebnis</translation>
    </message>
    <message>
        <source>Stored calibrations</source>
        <translation>Gespeicherte Kalibrierungen</translation>
    </message>
    <message>
        <source>Use</source>
        <translation>Nutzen</translation>
    </message>
    <message>
        <source>Switch off</source>
        <translation>Abschalten</translation>
    </message>
    <message>
        <source>Correct the axis&apos; readings with it</source>
        <translation>Die Messwerte der Achse damit korrigieren</translation>
    </message>
    <message>
        <source>axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>date</source>
        <translation>Datum</translation>
    </message>
    <message>
        <source>error before</source>
        <translation>Fehler vorher</translation>
    </message>
    <message>
        <source>after</source>
        <translation>nachher</translation>
    </message>
    <message>
        <source>state</source>
        <translation>Zustand</translation>
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
        <source>reading before</source>
        <translation>Messwert vorher</translation>
    </message>
    <message>
        <source>{axis}: {runs} runs, triangles and moves, {ends}, {time} min</source>
        <translation>{axis}: {runs} Läufe, Dreiecke und Bewegungen, {ends}, {time} min</translation>
    </message>
    <message>
        <source>{axis}: {runs} runs, ISO 230-2 cycles of {targets} targets, {ends}, {time} min</source>
        <translation>{axis}: {runs} Läufe, Zyklen nach ISO 230-2 mit {targets} Zielen, {ends}, {time} min</translation>
    </message>
    <message>
        <source>position reached</source>
        <translation>erreichte Position</translation>
    </message>
    <message>
        <source>{low} to {high}</source>
        <translation>{low} bis {high}</translation>
    </message>
    <message>
        <source>set-point [{unit}]</source>
        <translation>Sollwert [{unit}]</translation>
    </message>
    <message>
        <source>time [s]</source>
        <translation>Zeit [s]</translation>
    </message>
    <message>
        <source>before</source>
        <translation>vorher</translation>
    </message>
    <message>
        <source>error of the reading [{unit}]</source>
        <translation>Fehler des Messwerts [{unit}]</translation>
    </message>
    <message>
        <source>position [{unit}]</source>
        <translation>Position [{unit}]</translation>
    </message>
    <message>
        <source>Running: {share:.0f} %, {time} left</source>
        <translation>Läuft: {share:.0f} %, noch {time}</translation>
    </message>
    <message>
        <source>The run has failed: {message}.</source>
        <translation>Der Lauf ist fehlgeschlagen: {message}.</translation>
    </message>
    <message>
        <source>Refused: {reason}.</source>
        <translation>Abgelehnt: {reason}.</translation>
    </message>
    <message>
        <source>on</source>
        <translation>an</translation>
    </message>
    <message>
        <source>off</source>
        <translation>aus</translation>
    </message>
    <message>
        <source>select a calibration in the table</source>
        <translation>eine Kalibrierung in der Tabelle wählen</translation>
    </message>
    <message>
        <source>already on</source>
        <translation>schon an</translation>
    </message>
    <message>
        <source>already off</source>
        <translation>schon aus</translation>
    </message>
    <message>
        <source>Do not correct the readings of the axis</source>
        <translation>Die Messwerte der Achse nicht korrigieren</translation>
    </message>
    <message>
        <source>Store this calibration with its date, and correct the readings of the axis with it from now on</source>
        <translation>Diese Kalibrierung mit Datum speichern und die Messwerte der Achse ab jetzt damit korrigieren</translation>
    </message>
    <message>
        <source>already stored</source>
        <translation>schon gespeichert</translation>
    </message>
    <message>
        <source>Plan and run the motion, or fit records with the sensor and the laser.</source>
        <translation>Die Bewegung planen und starten, oder Aufzeichnungen mit Sensor und Laser anpassen.</translation>
    </message>
    <message>
        <source>The run is complete.</source>
        <translation>Der Lauf ist fertig.</translation>
    </message>
    <message>
        <source>Error in the validation runs: {before} rms before, {after} after.</source>
        <translation>Fehler in den Prüfläufen: {before} rms vorher, {after} nachher.</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>3 to 50; each run validates the fit of the others once; ISO 230-2 requires 5</source>
        <translation>3 bis 50; jeder Lauf prüft einmal die Anpassung der anderen; ISO 230-2 verlangt 5</translation>
    </message>
    <message>
        <source>5 to 101 positions, approached from both sides (ISO 230-2)</source>
        <translation>5 bis 101 Positionen, die von beiden Seiten angefahren werden (ISO 230-2)</translation>
    </message>
    <message>
        <source>Off: the zero of the laser is arbitrary; the reading at mid-travel stays</source>
        <translation>Aus: der Nullpunkt des Lasers ist beliebig; der Messwert in der Mitte des Bereichs bleibt</translation>
    </message>
    <message>
        <source>a run is in progress</source>
        <translation>ein Lauf ist im Gang</translation>
    </message>
    <message>
        <source>Compute the motion and check it against all limits</source>
        <translation>Die Bewegung berechnen und gegen alle Grenzen prüfen</translation>
    </message>
    <message>
        <source>Fit records of this axis with its sensor and the laser</source>
        <translation>Aufzeichnungen dieser Achse mit Sensor und Laser anpassen</translation>
    </message>
    <message>
        <source>Play the motion, record sensor and laser, and fit</source>
        <translation>Die Bewegung abspielen, Sensor und Laser aufzeichnen und anpassen</translation>
    </message>
    <message>
        <source>no run is in progress</source>
        <translation>kein Lauf ist im Gang</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Sensor calibration</source>
        <translation>Sensorkalibrierung</translation>
    </message>
</context>
</TS>
