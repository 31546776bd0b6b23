<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>panels</name>
    <message>
        <source>Plots</source>
        <translation>Diagramme</translation>
    </message>
</context>
<context>
    <name>plots</name>
    <message>
        <source>frequency [Hz]</source>
        <translation>Frequenz [Hz]</translation>
    </message>
    <message>
        <source>time [s]</source>
        <translation>Zeit [s]</translation>
    </message>
    <message>
        <source>cursor outside</source>
        <translation>Cursor außerhalb</translation>
    </message>
    <message>
        <source>a cursor is outside the measured samples</source>
        <translation>ein Cursor liegt außerhalb der Messwerte</translation>
    </message>
    <message>
        <source>Plots of the axes</source>
        <translation>Diagramme der Achsen</translation>
    </message>
    <message>
        <source>command</source>
        <translation>Sollwert</translation>
    </message>
    <message>
        <source>model in use</source>
        <translation>verwendetes Modell</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>gap, last {n} s</source>
        <translation>Abweichung, letzte {n} s</translation>
    </message>
    <message>
        <source>noise floor</source>
        <translation>Rauschgrenze</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>Gap: measured − model</source>
        <translation>Abweichung: gemessen − Modell</translation>
    </message>
    <message>
        <source>Loop: over command</source>
        <translation>Schleife: über Sollwert</translation>
    </message>
    <message>
        <source>Spectrum</source>
        <translation>Spektrum</translation>
    </message>
    <message>
        <source>The newest reading is {n} s old</source>
        <translation>Der neueste Messwert ist {n} s alt</translation>
    </message>
    <message>
        <source>{name} has no motion to align by: the ends are aligned.</source>
        <translation>{name} hat keine Bewegung zum Ausrichten: die Enden sind ausgerichtet.</translation>
    </message>
    <message>
        <source>Saved {path}</source>
        <translation>Gespeichert: {path}</translation>
    </message>
    <message>
        <source>No other run</source>
        <translation>Nur dieser</translation>
    </message>
    <message>
        <source>Keep this run</source>
        <translation>Lauf merken</translation>
    </message>
    <message>
        <source>nominal</source>
        <translation>nominal</translation>
    </message>
    <message>
        <source>Record …</source>
        <translation>Aufzeichnung …</translation>
    </message>
    <message>
        <source>Second run, drawn together with the present one</source>
        <translation>Zweiter Lauf, zusammen mit dem aktuellen gezeichnet</translation>
    </message>
    <message>
        <source>Keep this run: it stays visible together with the next one.</source>
        <translation>Lauf merken: Er bleibt zusammen mit dem nächsten sichtbar.</translation>
    </message>
    <message>
        <source>Record …: one of the library.</source>
        <translation>Aufzeichnung …: eine aus der Bibliothek.</translation>
    </message>
    <message>
        <source>Record as the second run</source>
        <translation>Aufzeichnung als zweiter Lauf</translation>
    </message>
    <message>
        <source>Cursors</source>
        <translation>Cursor</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Mehr</translation>
    </message>
    <message>
        <source>Align the other run</source>
        <translation>Den anderen Lauf ausrichten</translation>
    </message>
    <message>
        <source>Save picture …</source>
        <translation>Bild speichern …</translation>
    </message>
    <message>
        <source>Pictures (*.png *.svg)</source>
        <translation>Bilder (*.png *.svg)</translation>
    </message>
    <message>
        <source>Save data …</source>
        <translation>Daten speichern …</translation>
    </message>
    <message>
        <source>Records (*.csv *.csv.gz)</source>
        <translation>Aufzeichnungen (*.csv *.csv.gz)</translation>
    </message>
    <message>
        <source>The kept run</source>
        <translation>Der gemerkte Lauf</translation>
    </message>
    <message>
        <source>Gap of {axis}</source>
        <translation>Abweichung von {axis}</translation>
    </message>
    <message>
        <source>Band: noise floor of the sensor, {floor}</source>
        <translation>Band: Rauschgrenze des Sensors, {floor}</translation>
    </message>
    <message>
        <source>Red: beyond the following bound, {bound}</source>
        <translation>Rot: über der Schleppgrenze, {bound}</translation>
    </message>
    <message>
        <source>The library has no records: play or record a motion first.</source>
        <translation>Die Bibliothek hat keine Aufzeichnungen: zuerst eine Bewegung abspielen oder aufnehmen.</translation>
    </message>
    <message>
        <source>Contents of the plots</source>
        <translation>Inhalt der Diagramme</translation>
    </message>
    <message>
        <source>Time span of the plots</source>
        <translation>Zeitspanne der Diagramme</translation>
    </message>
    <message>
        <source>Two lines to drag; their values appear above each plot</source>
        <translation>Zwei verschiebbare Linien; ihre Werte stehen über jedem Diagramm</translation>
    </message>
    <message>
        <source>Freeze</source>
        <translation>Einfrieren</translation>
    </message>
    <message>
        <source>Freeze the plots; motion, recording and replay continue</source>
        <translation>Die Diagramme anhalten; Bewegung, Aufzeichnung und Wiedergabe gehen weiter</translation>
    </message>
    <message>
        <source>Alignment, and files of the plots</source>
        <translation>Ausrichtung und Dateien der Diagramme</translation>
    </message>
    <message>
        <source>There is no second run to align: choose one.</source>
        <translation>Es gibt keinen zweiten Lauf zum Ausrichten: einen wählen.</translation>
    </message>
    <message>
        <source>Latest run: the record that was opened or played last.</source>
        <translation>Letzter Lauf: die zuletzt geöffnete oder abgespielte Aufzeichnung.</translation>
    </message>
    <message>
        <source>There is no latest run: open or play one.</source>
        <translation>Es gibt keinen letzten Lauf: einen öffnen oder abspielen.</translation>
    </message>
    <message>
        <source>Latest run</source>
        <translation>Letzter Lauf</translation>
    </message>
    <message>
        <source>plots: there are no samples to save</source>
        <translation>Diagramme: keine Messwerte zum Speichern</translation>
    </message>
    <message>
        <source>Gap of the last {n} s, while an axis moves; logarithmic scale</source>
        <translation>Abweichung der letzten {n} s, solange sich eine Achse bewegt; logarithmische Skala</translation>
    </message>
    <message>
        <source>Amber: above the noise, {noise}</source>
        <translation>Gelb: über dem Rauschen, {noise}</translation>
    </message>
    <message>
        <source>Cursors: Δx and Δy of each loop appear above it.</source>
        <translation>Cursor: Δx und Δy jeder Schleife stehen darüber.</translation>
    </message>
    <message>
        <source>plots: there are no samples, so no run to keep</source>
        <translation>Diagramme: keine Messwerte, also kein Lauf zum Merken</translation>
    </message>
</context>
</TS>
