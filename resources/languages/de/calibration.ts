<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>calibration</name>
    <message>
        <source>Records (*.csv *.txt *.dat *.gz);;All files (*)</source>
        <translation>Aufzeichnungen (*.csv *.txt *.dat *.gz);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>What is shown</source>
        <translation>Was gezeigt wird</translation>
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
        <translation>Kalibrierung von {axis} in Gebrauch: {path}</translation>
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
        <source>3 to 50; each run is held out of the fit once; ISO 230-2 asks for 5</source>
        <translation>3 bis 50; jeder Lauf wird einmal von der Anpassung zurückgehalten; ISO 230-2 verlangt 5</translation>
    </message>
    <message>
        <source>Targets</source>
        <translation>Ziele</translation>
    </message>
    <message>
        <source>5 to 101 positions that are approached from both sides (ISO 230-2)</source>
        <translation>5 bis 101 Positionen, die von beiden Seiten angefahren werden (ISO 230-2)</translation>
    </message>
    <message>
        <source>the laser&apos;s zero is the axis&apos; zero</source>
        <translation>der Nullpunkt des Lasers ist der der Achse</translation>
    </message>
    <message>
        <source>Off: the laser was zeroed anywhere; the reading in the middle of the travel stays</source>
        <translation>Aus: der Laser wurde irgendwo genullt; der Messwert in der Mitte des Wegs bleibt</translation>
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
        <source>a run is under way</source>
        <translation>ein Lauf ist im Gang</translation>
    </message>
    <message>
        <source>Make the motion, and check it against all limits</source>
        <translation>Die Bewegung erstellen und gegen alle Grenzen prüfen</translation>
    </message>
    <message>
        <source>Fit records of this axis that hold its sensor and the laser</source>
        <translation>Aufzeichnungen dieser Achse anpassen, die Sensor und Laser enthalten</translation>
    </message>
    <message>
        <source>no run is under way</source>
        <translation>kein Lauf ist im Gang</translation>
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
        <source>Play the motion; sensor and laser are recorded and fitted</source>
        <translation>Die Bewegung abspielen; Sensor und Laser werden aufgezeichnet und angepasst</translation>
    </message>
    <message>
        <source>Keep this calibration, dated, and correct the axis&apos; readings by it from now on</source>
        <translation>Diese Kalibrierung mit Datum behalten und die Messwerte der Achse ab jetzt damit korrigieren</translation>
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
        <source>it is stored</source>
        <translation>es ist gespeichert</translation>
    </message>
    <message>
        <source>choose a calibration in the table</source>
        <translation>eine Kalibrierung in der Tabelle wählen</translation>
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
        <source>it is on</source>
        <translation>sie ist an</translation>
    </message>
    <message>
        <source>it is off</source>
        <translation>sie ist aus</translation>
    </message>
    <message>
        <source>Correct the axis&apos; readings with it</source>
        <translation>Die Messwerte der Achse damit korrigieren</translation>
    </message>
    <message>
        <source>Leave the axis&apos; readings as they are</source>
        <translation>Die Messwerte der Achse lassen, wie sie sind</translation>
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
        <source>Plan the motion and run it, or fit records that hold the sensor and the laser.</source>
        <translation>Die Bewegung planen und starten, oder Aufzeichnungen mit Sensor und Laser anpassen.</translation>
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
        <source>The run is done.</source>
        <translation>Der Lauf ist fertig.</translation>
    </message>
    <message>
        <source>Refused: {reason}.</source>
        <translation>Abgelehnt: {reason}.</translation>
    </message>
    <message>
        <source>Error at held-out runs: {before} rms before, {after} after.</source>
        <translation>Fehler bei zurückgehaltenen Läufen: {before} rms vorher, {after} nachher.</translation>
    </message>
    <message>
        <source>on</source>
        <translation>an</translation>
    </message>
    <message>
        <source>off</source>
        <translation>aus</translation>
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
