<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>panels</name>
    <message>
        <source>3-D view</source>
        <translation>3-D-Ansicht</translation>
    </message>
</context>
<context>
    <name>view3d</name>
    <message>
        <source>The robot in three dimensions</source>
        <translation>Der Roboter in drei Dimensionen</translation>
    </message>
    <message>
        <source>Drag to rotate, drag with the right button to shift, use the wheel to zoom, double-click to reset.</source>
        <translation>Ziehen dreht, Ziehen mit der rechten Taste verschiebt, das Rad zoomt, Doppelklick setzt zurück.</translation>
    </message>
    <message>
        <source>the view is being opened</source>
        <translation>die Ansicht wird geöffnet</translation>
    </message>
    <message>
        <source>Show the view in the browser of this desktop</source>
        <translation>Ansicht im Browser zeigen</translation>
    </message>
    <message>
        <source>Open in the browser</source>
        <translation>Im Browser</translation>
    </message>
    <message>
        <source>There is nothing to draw. {error}</source>
        <translation>Es gibt nichts zu zeichnen. {error}</translation>
    </message>
    <message>
        <source>From below</source>
        <translation>Von unten</translation>
    </message>
    <message>
        <source>Front</source>
        <translation>Vorn</translation>
    </message>
    <message>
        <source>Along +y, z up</source>
        <translation>Entlang +y, z nach oben</translation>
    </message>
    <message>
        <source>Top</source>
        <translation>Oben</translation>
    </message>
    <message>
        <source>Along −z</source>
        <translation>Entlang −z</translation>
    </message>
    <message>
        <source>Iso</source>
        <translation>Iso</translation>
    </message>
    <message>
        <source>The whole robot from the side</source>
        <translation>Der ganze Roboter von der Seite</translation>
    </message>
    <message>
        <source>Cell</source>
        <translation>Zelle</translation>
    </message>
    <message>
        <source>The cell, with the tip 0.3 mm next to it, to scale</source>
        <translation>Die Zelle, die Spitze 0,3 mm daneben, maßstäblich</translation>
    </message>
    <message>
        <source>Model and real</source>
        <translation>Modell und Maschine</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Real</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>Starting the 3-D view …</source>
        <translation>3-D-Ansicht wird gestartet …</translation>
    </message>
    <message>
        <source>No browser could be opened. The address is on the clipboard: paste it into a browser on this computer.</source>
        <translation>Kein Browser ließ sich öffnen. Die Adresse ist in der Zwischenablage: in einen Browser auf diesem Rechner einfügen.</translation>
    </message>
    <message>
        <source>Nano motion to scale</source>
        <translation>Nano maßstäblich</translation>
    </message>
    <message>
        <source>Nano motion × {factor}</source>
        <translation>Nano × {factor}</translation>
    </message>
    <message>
        <source>model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>real</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>{ghost}: position unknown, not drawn</source>
        <translation>{ghost}: Position unbekannt, nicht gezeichnet</translation>
    </message>
    <message>
        <source>The program does not answer: the drawing is out of date.</source>
        <translation>Das Programm antwortet nicht: die Zeichnung ist veraltet.</translation>
    </message>
    <message>
        <source>No data from the program: the drawing is out of date.</source>
        <translation>Keine Nachricht vom Programm: die Zeichnung ist veraltet.</translation>
    </message>
    <message>
        <source>View of the objective</source>
        <translation>Blick des Objektivs</translation>
    </message>
    <message>
        <source>outdated: the last reading is {age_s:.1f} s old</source>
        <translation>veraltet: der letzte Messwert ist {age_s:.1f} s alt</translation>
    </message>
    <message>
        <source>thx, thy, zn enlarged {factor:g} × about mid-range; the tip is not drawn in its place</source>
        <translation>thx, thy, zn {factor:g}-fach um die Bereichsmitte vergrößert; die Spitze ist nicht am rechten Ort gezeichnet</translation>
    </message>
    <message>
        <source>The view is not opened: {why}.</source>
        <translation>Die Ansicht wird nicht geöffnet: {why}.</translation>
    </message>
    <message>
        <source>it is being opened already</source>
        <translation>sie wird schon geöffnet</translation>
    </message>
    <message>
        <source>there is no drawing</source>
        <translation>es gibt keine Zeichnung</translation>
    </message>
    <message>
        <source>Robots to draw</source>
        <translation>Gezeichnete Roboter</translation>
    </message>
    <message>
        <source>Enlarge the motion of thx, thy and zn about mid-range</source>
        <translation>Die Bewegung von thx, thy und zn um die Bereichsmitte vergrößern</translation>
    </message>
    <message>
        <source>Magnification of nano motion</source>
        <translation>Vergrößerung der Nanobewegung</translation>
    </message>
</context>
</TS>
