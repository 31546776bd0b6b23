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
        <source>Cursors: Δx and Δy of each loop stand above it.</source>
        <translation>Cursor: Δx und Δy jeder Schleife stehen darüber.</translation>
    </message>
    <message>
        <source>cursor outside</source>
        <translation>Cursor außerhalb</translation>
    </message>
    <message>
        <source>a cursor stands where nothing was measured</source>
        <translation>ein Cursor steht, wo nichts gemessen wurde</translation>
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
        <translation>Modell im Einsatz</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>Gap: measured − model</source>
        <translation>Lücke: gemessen − Modell</translation>
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
        <source>There is no other run to align: choose one.</source>
        <translation>Es gibt keinen anderen Lauf zum Ausrichten: einen wählen.</translation>
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
        <source>What the plots show</source>
        <translation>Was die Diagramme zeigen</translation>
    </message>
    <message>
        <source>How far back the plots show</source>
        <translation>Wie weit die Diagramme zurückreichen</translation>
    </message>
    <message>
        <source>Another run beside the present one</source>
        <translation>Ein anderer Lauf neben dem jetzigen</translation>
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
        <source>Run in hand</source>
        <translation>Letzter Lauf</translation>
    </message>
    <message>
        <source>Keep this run: what is shown now stays, in green, beside what comes.</source>
        <translation>Lauf merken: was jetzt gezeigt wird, bleibt in Grün neben dem Kommenden.</translation>
    </message>
    <message>
        <source>Run in hand: the record that was opened or played last.</source>
        <translation>Letzter Lauf: die zuletzt geöffnete oder abgespielte Aufzeichnung.</translation>
    </message>
    <message>
        <source>Cursors</source>
        <translation>Cursor</translation>
    </message>
    <message>
        <source>Two lines to be dragged; what they read stands above each plot</source>
        <translation>Zwei verschiebbare Linien; ihre Werte stehen über jedem Diagramm</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Hold the picture still; motion, recording and replay go on</source>
        <translation>Das Bild anhalten; Bewegung, Aufnahme und Wiedergabe laufen weiter</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Mehr</translation>
    </message>
    <message>
        <source>Further views, alignment, and files of what is shown</source>
        <translation>Ausrichtung und Dateien des Gezeigten</translation>
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
        <source>There is no run in hand: open or play one.</source>
        <translation>Es gibt keinen letzten Lauf: einen öffnen oder abspielen.</translation>
    </message>
    <message>
        <source>nominal (dotted)</source>
        <translation>nominal (gepunktet)</translation>
    </message>
    <message>
        <source>plots: no samples are shown, so there is no run to keep</source>
        <translation>Diagramme: keine Messwerte gezeigt, also kein Lauf zum Merken</translation>
    </message>
    <message>
        <source>plots: no samples are shown, so there is nothing to save</source>
        <translation>Diagramme: keine Messwerte gezeigt, also nichts zu speichern</translation>
    </message>
</context>
</TS>
