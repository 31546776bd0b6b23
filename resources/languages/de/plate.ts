<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>panels</name>
    <message>
        <source>Holding plate</source>
        <translation>Halteplatte</translation>
    </message>
</context>
<context>
    <name>plate</name>
    <message>
        <source>The plate in 3-D</source>
        <translation>Die Platte in 3-D</translation>
    </message>
    <message>
        <source>relative</source>
        <translation>relativ</translation>
    </message>
    <message>
        <source>The plate with its hub moved, or one of its modes</source>
        <translation>Die Platte mit bewegter Nabe oder eine ihrer Eigenformen</translation>
    </message>
    <message>
        <source>Colours</source>
        <translation>Farben</translation>
    </message>
    <message>
        <source>Quantity shown by the colours</source>
        <translation>Größe, die die Farben zeigen</translation>
    </message>
    <message>
        <source>{axis} of the hub</source>
        <translation>{axis} der Nabe</translation>
    </message>
    <message>
        <source>{axis} of the hub over its range, in {unit}</source>
        <translation>{axis} der Nabe über ihren Bereich, in {unit}</translation>
    </message>
    <message>
        <source>Scale of the deformation</source>
        <translation>Maßstab der Verformung</translation>
    </message>
    <message>
        <source>Scale of the drawn deformation, 0 to 200 %; 100 % is well visible</source>
        <translation>Maßstab der gezeichneten Verformung, 0 bis 200 %; 100 % sind gut sichtbar</translation>
    </message>
    <message>
        <source>Mesh lines</source>
        <translation>Netzlinien</translation>
    </message>
    <message>
        <source>Draw the edges of the elements</source>
        <translation>Die Kanten der Elemente zeichnen</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>Zeigen</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>Maßstab</translation>
    </message>
    <message>
        <source>{axis} of the hub, {low:.4g} to {high:.4g} {unit}</source>
        <translation>{axis} der Nabe, {low:.4g} bis {high:.4g} {unit}</translation>
    </message>
    <message>
        <source>Mode {title}</source>
        <translation>Form {title}</translation>
    </message>
    <message>
        <source>Mesh</source>
        <translation>Netz</translation>
    </message>
    <message>
        <source>Solve</source>
        <translation>Berechnen</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Save VTU …</source>
        <translation>VTU speichern …</translation>
    </message>
    <message>
        <source>Save PNG …</source>
        <translation>PNG speichern …</translation>
    </message>
    <message>
        <source>The plate as a whole</source>
        <translation>Die Platte als Ganzes</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>wartet</translation>
    </message>
    <message>
        <source>Stopped.</source>
        <translation>Abgebrochen.</translation>
    </message>
    <message>
        <source>{triangles} triangles, {unknowns} unknowns.</source>
        <translation>{triangles} Dreiecke, {unknowns} Unbekannte.</translation>
    </message>
    <message>
        <source>Failed.</source>
        <translation>Fehlgeschlagen.</translation>
    </message>
    <message>
        <source>Solving: {stage} …</source>
        <translation>Berechnung: {stage} …</translation>
    </message>
    <message>
        <source>the plate is being computed; stop that first</source>
        <translation>die Platte wird gerade berechnet; erst abbrechen</translation>
    </message>
    <message>
        <source>nothing is being computed</source>
        <translation>nichts wird berechnet</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Save the plate</source>
        <translation>Die Platte speichern</translation>
    </message>
    <message>
        <source>Mode {number}, {frequency:.0f} Hz</source>
        <translation>Eigenform {number}, {frequency:.0f} Hz</translation>
    </message>
    <message>
        <source>Von Mises stress</source>
        <translation>Von-Mises-Spannung</translation>
    </message>
    <message>
        <source>Larger principal stress, top</source>
        <translation>Größere Hauptspannung, oben</translation>
    </message>
    <message>
        <source>Smaller principal stress, top</source>
        <translation>Kleinere Hauptspannung, oben</translation>
    </message>
    <message>
        <source>Deflection</source>
        <translation>Durchbiegung</translation>
    </message>
    <message>
        <source>meshing</source>
        <translation>Vernetzung</translation>
    </message>
    <message>
        <source>solving</source>
        <translation>Lösung</translation>
    </message>
    <message>
        <source>modes</source>
        <translation>Eigenformen</translation>
    </message>
    <message>
        <source>range of motion</source>
        <translation>Bewegungsbereich</translation>
    </message>
    <message>
        <source>drawing</source>
        <translation>Zeichnung</translation>
    </message>
    <message>
        <source>Coarse mesh</source>
        <translation>Grobes Netz</translation>
    </message>
    <message>
        <source>Default mesh</source>
        <translation>Normales Netz</translation>
    </message>
    <message>
        <source>Fine mesh</source>
        <translation>Feines Netz</translation>
    </message>
    <message>
        <source>Solve the plate of this robot to see its stress, its deformation and its modes.</source>
        <translation>Die Platte dieses Roboters berechnen, um Spannung, Verformung und Eigenformen zu sehen.</translation>
    </message>
    <message>
        <source>hub along the pin</source>
        <translation>Nabe längs des Stifts</translation>
    </message>
    <message>
        <source>plate between hub and rim</source>
        <translation>Platte zwischen Nabe und Rand</translation>
    </message>
    <message>
        <source>Reaction {force:.1f} N; {x:.1f} and {y:.1f} N mm about x and y</source>
        <translation>Reaktion {force:.1f} N; {x:.1f} und {y:.1f} N mm um x und y</translation>
    </message>
    <message>
        <source>{stress:.1f} MPa von Mises {place}; safety {factor:.2f} against yield at {limit:.0f} MPa</source>
        <translation>{stress:.1f} MPa von Mises {place}; Sicherheit {factor:.2f} gegen Fließen bei {limit:.0f} MPa</translation>
    </message>
    <message>
        <source>THE PLATE YIELDS: {said}</source>
        <translation>DIE PLATTE FLIESST: {said}</translation>
    </message>
    <message>
        <source>between hub and rim, r {radius:.2f} mm, {degrees:.0f}°</source>
        <translation>zwischen Nabe und Rand, r {radius:.2f} mm, {degrees:.0f}°</translation>
    </message>
    <message>
        <source>at the hub, r {radius:.2f} mm, {degrees:.0f}°</source>
        <translation>an der Nabe, r {radius:.2f} mm, {degrees:.0f}°</translation>
    </message>
    <message>
        <source>at the rim, r {radius:.2f} mm, {degrees:.0f}°</source>
        <translation>am Rand, r {radius:.2f} mm, {degrees:.0f}°</translation>
    </message>
    <message>
        <source>{axial:.3f} N/µm along the pin; {x:.4g} and {y:.4g} N m/rad in tilt: they agree with the shipped robot within {tolerance}</source>
        <translation>{axial:.3f} N/µm längs des Stifts; {x:.4g} und {y:.4g} N m/rad beim Kippen: stimmen mit dem mitgelieferten Roboter auf {tolerance} überein</translation>
    </message>
    <message>
        <source>{axial:.3f} N/µm along the pin; {x:.4g} and {y:.4g} N m/rad in tilt: they do not agree with the shipped robot within {tolerance}</source>
        <translation>{axial:.3f} N/µm längs des Stifts; {x:.4g} und {y:.4g} N m/rad beim Kippen: stimmen mit dem mitgelieferten Roboter nicht auf {tolerance} überein</translation>
    </message>
    <message>
        <source>Whole range: {safety}, at {pose}</source>
        <translation>Ganzer Bereich: {safety}, bei {pose}</translation>
    </message>
    <message>
        <source>hub tilts about {angle}</source>
        <translation>Nabe kippt um {angle}</translation>
    </message>
    <message>
        <source>no plate is solved yet</source>
        <translation>es gibt noch keine berechnete Platte</translation>
    </message>
    <message>
        <source>A finer mesh is more accurate and takes longer</source>
        <translation>Ein feineres Netz ist genauer und dauert länger</translation>
    </message>
    <message>
        <source>Compute the plate of the robot file; motion continues</source>
        <translation>Die Platte der Roboterdatei berechnen; die Bewegung geht weiter</translation>
    </message>
    <message>
        <source>Cancel the computation; motion continues</source>
        <translation>Die Berechnung abbrechen; die Bewegung geht weiter</translation>
    </message>
    <message>
        <source>In this pose</source>
        <translation>In dieser Stellung</translation>
    </message>
    <message>
        <source>Mesh, displacement, stress and modes for ParaView and similar programs</source>
        <translation>Netz, Verschiebung, Spannung und Eigenformen für ParaView und ähnliche Programme</translation>
    </message>
    <message>
        <source>The displayed picture</source>
        <translation>Das gezeigte Bild</translation>
    </message>
    <message>
        <source>Drag to rotate, use the wheel to zoom, double-click to reset; also arrow keys, + and −</source>
        <translation>Ziehen dreht, das Rad zoomt, ein Doppelklick setzt zurück; auch Pfeiltasten, + und −</translation>
    </message>
    <message>
        <source>Moved hub</source>
        <translation>Bewegte Nabe</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
</context>
</TS>
