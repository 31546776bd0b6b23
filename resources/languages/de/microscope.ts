<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>microscope</name>
    <message>
        <source>Calibration</source>
        <translation>Kalibrierung</translation>
    </message>
    <message>
        <source>the whole picture moves</source>
        <translation>das ganze Bild bewegt sich</translation>
    </message>
    <message>
        <source>Micro stage</source>
        <translation>Mikrotisch</translation>
    </message>
    <message>
        <source>Nano stage</source>
        <translation>Nanotisch</translation>
    </message>
    <message>
        <source>Abort</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Progress of the calibration</source>
        <translation>Fortschritt der Kalibrierung</translation>
    </message>
    <message>
        <source>focus: sharpest at {place:.2f} ± {doubt:.2f} µm of {axis}</source>
        <translation>Fokus: am schärfsten bei {place:.2f} ± {doubt:.2f} µm von {axis}</translation>
    </message>
    <message>
        <source>whole</source>
        <translation>ganz</translation>
    </message>
    <message>
        <source>exposure</source>
        <translation>Belichtung</translation>
    </message>
    <message>
        <source>gain</source>
        <translation>Verstärkung</translation>
    </message>
    <message>
        <source>rate</source>
        <translation>Bildrate</translation>
    </message>
    <message>
        <source>{low:g} to {high:g} {unit}</source>
        <translation>{low:g} bis {high:g} {unit}</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>e.g. opencv:film.avi</source>
        <translation>oder etwa opencv:film.avi</translation>
    </message>
    <message>
        <source>Source and address of another camera</source>
        <translation>Quelle und Adresse einer anderen Kamera</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Close the camera</source>
        <translation>Die Kamera schließen</translation>
    </message>
    <message>
        <source>Objective</source>
        <translation>Objektiv</translation>
    </message>
    <message>
        <source>no camera is open</source>
        <translation>keine Kamera offen</translation>
    </message>
    <message>
        <source>Camera settings</source>
        <translation>Kameraeinstellungen</translation>
    </message>
    <message>
        <source>Pixel type</source>
        <translation>Pixeltyp</translation>
    </message>
    <message>
        <source>Trigger</source>
        <translation>Auslöser</translation>
    </message>
    <message>
        <source>Loop at the end</source>
        <translation>am Ende neu beginnen</translation>
    </message>
    <message>
        <source>Exposure [ms]</source>
        <translation>Belichtung [ms]</translation>
    </message>
    <message>
        <source>Gain</source>
        <translation>Verstärkung</translation>
    </message>
    <message>
        <source>Rate [Hz]</source>
        <translation>Rate [Hz]</translation>
    </message>
    <message>
        <source>Region [px]</source>
        <translation>Ausschnitt [px]</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Setzen</translation>
    </message>
    <message>
        <source>Apply these settings; refusals appear below</source>
        <translation>Diese Einstellungen anwenden; Ablehnungen erscheinen darunter</translation>
    </message>
    <message>
        <source>Use visible region</source>
        <translation>Sichtbares</translation>
    </message>
    <message>
        <source>Take picture</source>
        <translation>Bild aufnehmen</translation>
    </message>
    <message>
        <source>Trigger the camera once</source>
        <translation>Kamera einmal auslösen</translation>
    </message>
    <message>
        <source>unchanged</source>
        <translation>unverändert</translation>
    </message>
    <message>
        <source>cannot be set</source>
        <translation>nicht einstellbar</translation>
    </message>
    <message>
        <source>{whole}, or first column, first row, width and height of the sensor&apos;s {width} × {height} px</source>
        <translation>{whole}, oder erste Spalte, erste Zeile, Breite und Höhe der {width} × {height} px des Sensors</translation>
    </message>
    <message>
        <source>live</source>
        <translation>live</translation>
    </message>
    <message>
        <source>off</source>
        <translation>aus</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>fehlgeschlagen</translation>
    </message>
    <message>
        <source>micro</source>
        <translation>Mikro</translation>
    </message>
    <message>
        <source>nano</source>
        <translation>Nano</translation>
    </message>
    <message>
        <source>tip</source>
        <translation>Spitze</translation>
    </message>
    <message>
        <source>there is no picture</source>
        <extracomment>Whether a move is planned. A stop cancels it at once, before the next refresh.</extracomment>
        <translation>kein Bild</translation>
    </message>
    <message>
        <source>Move the tip {how}?</source>
        <translation>Spitze fahren: {how}?</translation>
    </message>
    <message>
        <source>Histogram with the levels of black and white</source>
        <translation>Histogramm mit Schwarz- und Weißpegel</translation>
    </message>
    <message>
        <source>a video is being recorded; end it first</source>
        <extracomment>Whether videos start and end with recordings.</extracomment>
        <translation>ein Video läuft; zuerst beenden</translation>
    </message>
    <message>
        <source>there is no picture to record; open a camera first</source>
        <translation>kein Bild zum Aufnehmen; zuerst eine Kamera öffnen</translation>
    </message>
    <message>
        <source>no video is being recorded</source>
        <translation>kein Video läuft</translation>
    </message>
    <message>
        <source>Saved {path}: {pictures} pictures of {seconds:.1f} s</source>
        <translation>{path} gespeichert: {pictures} Bilder aus {seconds:.1f} s</translation>
    </message>
    <message>
        <source>{pictures} pictures, {seconds:.0f} s, {megabytes:.0f} MB</source>
        <translation>{pictures} Bilder, {seconds:.0f} s, {megabytes:.0f} MB</translation>
    </message>
    <message>
        <source>Snapshot</source>
        <translation>Schnappschuss</translation>
    </message>
    <message>
        <source>● Video</source>
        <translation>● Video</translation>
    </message>
    <message>
        <source>video with each recording</source>
        <translation>Video zu jeder Aufnahme</translation>
    </message>
    <message>
        <source>■ End video</source>
        <translation>■ Video beenden</translation>
    </message>
    <message>
        <source>End the video</source>
        <translation>Video beenden</translation>
    </message>
    <message>
        <source>Record every picture, with its time, as a BigTIFF</source>
        <translation>Jedes Bild mit Zeitpunkt als BigTIFF aufnehmen</translation>
    </message>
    <message>
        <source>No snapshot: there is no picture. Open a camera first.</source>
        <translation>Kein Schnappschuss: es gibt kein Bild. Erst eine Kamera öffnen.</translation>
    </message>
    <message>
        <source>Saved {tiff} and {png}.png</source>
        <translation>{tiff} und {png}.png gespeichert</translation>
    </message>
    <message>
        <source>Writing a picture …</source>
        <translation>Bild wird geschrieben …</translation>
    </message>
    <message>
        <source>Ending the video …</source>
        <translation>Video wird beendet …</translation>
    </message>
    <message>
        <source>nano, else micro</source>
        <translation>Nano, sonst Mikro</translation>
    </message>
    <message>
        <source>Click to move</source>
        <translation>Klick zum Fahren</translation>
    </message>
    <message>
        <source>Stage that a click moves</source>
        <translation>Tisch, den ein Klick fährt</translation>
    </message>
    <message>
        <source>Go back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Halt</translation>
    </message>
    <message>
        <source>the machine is not at rest</source>
        <translation>die Maschine ruht nicht</translation>
    </message>
    <message>
        <source>Targets</source>
        <translation>Ziele</translation>
    </message>
    <message>
        <source>Targets, in order</source>
        <translation>Ziele, der Reihe nach</translation>
    </message>
    <message>
        <source>Visit next</source>
        <translation>Nächstes anfahren</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Clear</source>
        <translation>Leeren</translation>
    </message>
    <message>
        <source>every target has been visited</source>
        <translation>alle Ziele wurden angefahren</translation>
    </message>
    <message>
        <source>the tip is on its way to a target</source>
        <translation>die Spitze ist unterwegs zu einem Ziel</translation>
    </message>
    <message>
        <source>Delete all targets</source>
        <translation>Alle Ziele löschen</translation>
    </message>
    <message>
        <source>nano range</source>
        <translation>Nano-Bereich</translation>
    </message>
    <message>
        <source>{distance} with the {stage} stage</source>
        <translation>{distance} mit dem {stage}-Tisch</translation>
    </message>
    <message>
        <source>tip lost</source>
        <translation>Spitze verloren</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>Calibrate</source>
        <translation>Kalibrieren</translation>
    </message>
    <message>
        <source>Move</source>
        <translation>Fahren</translation>
    </message>
    <message>
        <source>Vision</source>
        <translation>Erkennen</translation>
    </message>
    <message>
        <source>Map</source>
        <translation>Karte</translation>
    </message>
    <message>
        <source>– no tools –</source>
        <translation>– ohne –</translation>
    </message>
    <message>
        <source>{mode}: Esc ends it   </source>
        <translation>{mode}: Esc beendet   </translation>
    </message>
    <message>
        <source>Contrast</source>
        <translation>Kontrast</translation>
    </message>
    <message>
        <source>automatic levels</source>
        <translation>automatische Pegel</translation>
    </message>
    <message>
        <source>Black and white at 0.1 and 99.9 % of the pixels</source>
        <translation>Schwarz und Weiß bei 0,1 und 99,9 % der Pixel</translation>
    </message>
    <message>
        <source>Full range</source>
        <translation>Ganzer Bereich</translation>
    </message>
    <message>
        <source>Black at 0, white at the largest number</source>
        <translation>Schwarz bei 0, Weiß beim größten Wert</translation>
    </message>
    <message>
        <source>Gamma</source>
        <translation>Gamma</translation>
    </message>
    <message>
        <source>Colours</source>
        <translation>Farben</translation>
    </message>
    <message>
        <source>gamma {gamma:.2f}</source>
        <translation>Gamma {gamma:.2f}</translation>
    </message>
    <message>
        <source>Over the picture</source>
        <translation>Über dem Bild</translation>
    </message>
    <message>
        <source>Show over the picture: {layer}</source>
        <translation>Über dem Bild zeigen: {layer}</translation>
    </message>
    <message>
        <source>Picture of the microscope</source>
        <translation>Bild des Mikroskops</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>{across:.1f}, {down:.1f} µm from the corner</source>
        <translation>{across:.1f}, {down:.1f} µm von der Ecke</translation>
    </message>
    <message>
        <source>{number} of {largest}</source>
        <translation>{number} von {largest}</translation>
    </message>
    <message>
        <source>, {angle:.1f}° to the pipette</source>
        <translation>, {angle:.1f}° zur Pipette</translation>
    </message>
    <message>
        <source>not calibrated</source>
        <translation>nicht kalibriert</translation>
    </message>
    <message>
        <source>No camera</source>
        <translation>Keine Kamera</translation>
    </message>
    <message>
        <source>Opening …</source>
        <translation>Wird geöffnet …</translation>
    </message>
    <message>
        <source>Waiting for a trigger</source>
        <translation>Wartet auf Auslöser</translation>
    </message>
    <message>
        <source>STALLED</source>
        <translation>STOCKT</translation>
    </message>
    <message>
        <source>FROZEN</source>
        <translation>EINGEFROREN</translation>
    </message>
    <message>
        <source>BLACK</source>
        <translation>SCHWARZ</translation>
    </message>
    <message>
        <source>LOST</source>
        <translation>VERLOREN</translation>
    </message>
    <message>
        <source>opened</source>
        <translation>geöffnet</translation>
    </message>
    <message>
        <source>Waiting for the first picture</source>
        <translation>Wartet auf das erste Bild</translation>
    </message>
    <message>
        <source>{lost} lost</source>
        <translation>{lost} verloren</translation>
    </message>
    <message>
        <source>Choose a camera under Tools, Camera, and open it.</source>
        <translation>Unter Kamera, neben dem Bild, eine wählen und öffnen.</translation>
    </message>
    <message>
        <source>{ms:.0f} ms old</source>
        <translation>vor {ms:.0f} ms</translation>
    </message>
    <message>
        <source>{s:.1f} s old</source>
        <translation>vor {s:.1f} s</translation>
    </message>
    <message>
        <source>the picture is not live: {state}</source>
        <translation>das Bild ist nicht live: {state}</translation>
    </message>
    <message>
        <source>motion is locked: {locked}</source>
        <translation>Bewegung gesperrt: {locked}</translation>
    </message>
    <message>
        <source>Mark</source>
        <translation>Ziel</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Messen</translation>
    </message>
    <message>
        <source>Drag a line: its length and angles; nothing moves</source>
        <translation>Eine Linie ziehen: Länge und Winkel; nichts bewegt sich</translation>
    </message>
    <message>
        <source>Tip</source>
        <translation>Spitze</translation>
    </message>
    <message>
        <source>Click near the pipette&apos;s tip: track it from there; nothing moves</source>
        <translation>Nahe der Pipettenspitze klicken: von dort verfolgen; nichts bewegt sich</translation>
    </message>
    <message>
        <source>Cell</source>
        <translation>Zelle</translation>
    </message>
    <message>
        <source>Click into a cell: find its outline; nothing moves</source>
        <translation>In eine Zelle klicken: Umriss suchen; nichts bewegt sich</translation>
    </message>
    <message>
        <source>Tools next to the picture</source>
        <translation>Werkzeuge neben dem Bild</translation>
    </message>
    <message>
        <source>Map of the tip</source>
        <translation>Karte der Spitze</translation>
    </message>
    <message>
        <source>Go there</source>
        <translation>Anfahren</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Alles</translation>
    </message>
    <message>
        <source>Show the trail and all places</source>
        <translation>Die Spur und alle Orte zeigen</translation>
    </message>
    <message>
        <source>Reach</source>
        <translation>Reichweite</translation>
    </message>
    <message>
        <source>Show everything within reach of the axes</source>
        <translation>Alles zeigen, was die Achsen erreichen</translation>
    </message>
    <message>
        <source>Clear trail</source>
        <translation>Spur löschen</translation>
    </message>
    <message>
        <source>Clear the trail of the tip; nothing moves</source>
        <translation>Die Spur der Spitze löschen; nichts bewegt sich</translation>
    </message>
    <message>
        <source>no place is chosen</source>
        <translation>kein Ort ist gewählt</translation>
    </message>
    <message>
        <source>the position is not known</source>
        <translation>die Position ist nicht bekannt</translation>
    </message>
    <message>
        <source>Raise the tip above both places, move across, lower it</source>
        <translation>Die Spitze über beide Orte heben, verfahren, absenken</translation>
    </message>
    <message>
        <source>{way} from here; longest move: {axis}</source>
        <translation>{way} von hier; längster Weg: {axis}</translation>
    </message>
    <message>
        <source>Far away: go there?</source>
        <translation>Weit entfernt: hinfahren?</translation>
    </message>
    <message>
        <source>No move: no place is chosen. Choose one in the map.</source>
        <translation>Keine Bewegung: kein Ort ist gewählt. Einen in der Karte wählen.</translation>
    </message>
    <message>
        <source>Click a place to choose it.</source>
        <translation>Einen Ort anklicken, um ihn zu wählen.</translation>
    </message>
    <message>
        <source>Position {name}</source>
        <translation>Position {name}</translation>
    </message>
    <message>
        <source>Cell {name}</source>
        <translation>Zelle {name}</translation>
    </message>
    <message>
        <source>Free place</source>
        <translation>Freier Ort</translation>
    </message>
    <message>
        <source>tip x, y, z [mm]: {place}</source>
        <translation>Spitze x, y, z [mm]: {place}</translation>
    </message>
    <message>
        <source>Show all of the picture (F)</source>
        <translation>Das ganze Bild zeigen (F)</translation>
    </message>
    <message>
        <source>One camera pixel per screen pixel (1)</source>
        <translation>Ein Kamerapixel je Bildschirmpixel (1)</translation>
    </message>
    <message>
        <source>track the tip</source>
        <translation>Spitze verfolgen</translation>
    </message>
    <message>
        <source>Take background</source>
        <translation>Hintergrund aufnehmen</translation>
    </message>
    <message>
        <source>monitor drift</source>
        <translation>Drift beobachten</translation>
    </message>
    <message>
        <source>taken</source>
        <translation>aufgenommen</translation>
    </message>
    <message>
        <source>not taken yet</source>
        <translation>noch nicht aufgenommen</translation>
    </message>
    <message>
        <source>Remove the outline</source>
        <translation>Den Umriss entfernen</translation>
    </message>
    <message>
        <source>Position of the focus drive, µm</source>
        <translation>Position des Fokustriebs, µm</translation>
    </message>
    <message>
        <source>Target of the drive, µm, within its range</source>
        <translation>Ziel des Antriebs, µm, innerhalb seines Bereichs</translation>
    </message>
    <message>
        <source>no cell is outlined</source>
        <translation>keine Zelle umrissen</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>Fokus</translation>
    </message>
    <message>
        <source>Autofocus</source>
        <translation>Autofokus</translation>
    </message>
    <message>
        <source>Find the sharpest focus and stay there</source>
        <translation>Den schärfsten Ort suchen und dort bleiben</translation>
    </message>
    <message>
        <source>focus at, µm</source>
        <translation>Fokus, µm</translation>
    </message>
    <message>
        <source>Move focus</source>
        <translation>Fokus fahren</translation>
    </message>
    <message>
        <source>Move the focus drive of the microscope</source>
        <translation>Den Fokustrieb des Mikroskops fahren</translation>
    </message>
    <message>
        <source>Z-stack</source>
        <translation>Z-Stapel</translation>
    </message>
    <message>
        <source>first, µm</source>
        <translation>erster, µm</translation>
    </message>
    <message>
        <source>last, µm</source>
        <translation>letzter, µm</translation>
    </message>
    <message>
        <source>step, µm</source>
        <translation>Schritt, µm</translation>
    </message>
    <message>
        <source>Step from picture to picture, above 0 µm</source>
        <translation>Schritt von Bild zu Bild, über 0 µm</translation>
    </message>
    <message>
        <source>Take stack</source>
        <translation>Stapel aufnehmen</translation>
    </message>
    <message>
        <source>Writing a z-stack …</source>
        <translation>Ein Z-Stapel wird geschrieben …</translation>
    </message>
    <message>
        <source>Saved {path}, {count} pictures</source>
        <translation>{path} gespeichert, {count} Bilder</translation>
    </message>
    <message>
        <source>{done} of {total} pictures</source>
        <translation>{done} von {total} Bildern</translation>
    </message>
    <message>
        <source>this camera has no focus drive</source>
        <translation>diese Kamera hat keinen Fokustrieb</translation>
    </message>
    <message>
        <source>focus</source>
        <translation>Fokus</translation>
    </message>
    <message>
        <source>calibrated</source>
        <translation>kalibriert</translation>
    </message>
    <message>
        <source>{name}: not calibrated</source>
        <translation>{name}: nicht kalibriert</translation>
    </message>
    <message>
        <source>, mirrored</source>
        <translation>, gespiegelt</translation>
    </message>
    <message>
        <source>move {number}: {size:.2f} px</source>
        <translation>Bewegung {number}: {size:.2f} px</translation>
    </message>
    <message>
        <source>Failed: {reason}</source>
        <translation>Fehlgeschlagen: {reason}</translation>
    </message>
    <message>
        <source>, {miss:.2f} px off</source>
        <translation>, {miss:.2f} px daneben</translation>
    </message>
    <message>
        <source>Arrived</source>
        <translation>Angekommen</translation>
    </message>
    <message>
        <source>Under way</source>
        <translation>Unterwegs</translation>
    </message>
    <message>
        <source>1 correction</source>
        <translation>1 Korrektur</translation>
    </message>
    <message>
        <source>{n} corrections</source>
        <translation>{n} Korrekturen</translation>
    </message>
    <message>
        <source>{distance} ± {uncertainty:.2f} µm from focus</source>
        <translation>{distance} ± {uncertainty:.2f} µm vom Fokus</translation>
    </message>
    <message>
        <source>quality {quality:.0f} %</source>
        <translation>Güte {quality:.0f} %</translation>
    </message>
    <message>
        <source>{size}
membrane: {ahead} from its normal</source>
        <translation>{size}
Membran: {ahead} zur Membrannormalen</translation>
    </message>
    <message>
        <source>watching</source>
        <translation>beobachtet</translation>
    </message>
    <message>
        <source>{right:.2f}, {down:.2f} px since the background was taken</source>
        <translation>{right:.2f}, {down:.2f} px seit Aufnahme des Hintergrunds</translation>
    </message>
    <message>
        <source>Sharpest at {place:.2f} ± {doubt:.2f} µm</source>
        <translation>Am schärfsten bei {place:.2f} ± {doubt:.2f} µm</translation>
    </message>
    <message>
        <source>focus drive</source>
        <translation>Fokustrieb</translation>
    </message>
    <message>
        <source>axis {name}</source>
        <translation>Achse {name}</translation>
    </message>
    <message>
        <source>With Move, above the picture, a click or a drag sends the tip there. Esc or any stop ends this mode.</source>
        <translation>Mit „Fahren“ über dem Bild fährt die Spitze zum Klick oder Zugende. Esc oder jeder Halt beendet das.</translation>
    </message>
    <message>
        <source>Stage that a click moves; nano within its range</source>
        <translation>Tisch, den ein Klick fährt; Nano in seinem Bereich</translation>
    </message>
    <message>
        <source>Return to the position before the latest move</source>
        <translation>Zurück zur Position vor der letzten Fahrt</translation>
    </message>
    <message>
        <source>no move is running</source>
        <translation>keine Fahrt läuft</translation>
    </message>
    <message>
        <source>Stop the machine in place</source>
        <translation>Die Maschine anhalten</translation>
    </message>
    <message>
        <source>no target is marked; use Mark above the picture</source>
        <translation>kein Ziel markiert; „Ziel“ über dem Bild verwenden</translation>
    </message>
    <message>
        <source>Send the tip to the first unvisited target</source>
        <translation>Spitze zum ersten noch nicht angefahrenen Ziel fahren</translation>
    </message>
    <message>
        <source>no target is selected</source>
        <translation>kein Ziel gewählt</translation>
    </message>
    <message>
        <source>Delete the selected target</source>
        <translation>Das gewählte Ziel löschen</translation>
    </message>
    <message>
        <source>Drive that moves the focus</source>
        <translation>Antrieb, der den Fokus bewegt</translation>
    </message>
    <message>
        <source>no focus drive is available: open a camera or connect the machine</source>
        <translation>kein Antrieb zum Fokussieren: Kamera öffnen oder Maschine verbinden</translation>
    </message>
    <message>
        <source>Take a picture at each position and return</source>
        <translation>An jeder Position ein Bild aufnehmen und zurückfahren</translation>
    </message>
    <message>
        <source>First position, µm, within the range of the drive</source>
        <translation>Erste Position, µm, im Bereich des Antriebs</translation>
    </message>
    <message>
        <source>Last position, µm, within the range of the drive</source>
        <translation>Letzte Position, µm, im Bereich des Antriebs</translation>
    </message>
    <message>
        <source>{name}: {text!r} is not a number; enter one in µm</source>
        <translation>{name}: {text!r} ist keine Zahl; eine in µm eingeben</translation>
    </message>
    <message>
        <source>{folder}: the folder cannot be created ({reason})</source>
        <translation>{folder}: der Ordner lässt sich nicht anlegen ({reason})</translation>
    </message>
    <message>
        <source>{text}, {dropped} dropped</source>
        <translation>{text}, {dropped} ausgelassen</translation>
    </message>
    <message>
        <source>Click or drag: the tip moves there. Esc or any stop ends this mode</source>
        <translation>Klicken oder ziehen: die Spitze fährt dorthin. Esc oder jeder Halt beendet das</translation>
    </message>
    <message>
        <source>Click: mark a target for a visit; nothing moves</source>
        <translation>Klicken: ein Ziel zum Anfahren markieren; nichts bewegt sich</translation>
    </message>
    <message>
        <source>makes small moves</source>
        <translation>bewegt sich wenig</translation>
    </message>
    <message>
        <source>returns to the start</source>
        <translation>fährt an den Anfang zurück</translation>
    </message>
    <message>
        <source>{name}: {found}, residual {residual:.2f} px, {when}</source>
        <translation>{name}: {found}, Restfehler {residual:.2f} px, {when}</translation>
    </message>
    <message>
        <source>{sizes} ± {doubts:.2f} nm/px, rotated {rotation:.3f} ± {doubt:.3f}°, skew {skew:.3f}°{hand}</source>
        <translation>{sizes} ± {doubts:.2f} nm/px, gedreht {rotation:.3f} ± {doubt:.3f}°, Scherung {skew:.3f}°{hand}</translation>
    </message>
    <message>
        <source>{phase}: picture {done} of {moves}</source>
        <translation>{phase}: Bild {done} von {moves}</translation>
    </message>
    <message>
        <source>, omitted</source>
        <translation>, ausgelassen</translation>
    </message>
    <message>
        <source>{places} positions evaluated</source>
        <translation>{places} Positionen ausgewertet</translation>
    </message>
    <message>
        <source>1. Bring the tip to the middle of the picture and into focus.
2. Choose the objective under Camera: each objective has its own calibration.
3. Calibrate the micro stage, then the nano stage: the tip makes small moves around its position and returns.</source>
        <translation>1. Spitze in die Bildmitte und in den Fokus bringen.
2. Objektiv unter Kamera wählen: jedes hat eine eigene Kalibrierung.
3. Mikrotisch, dann Nanotisch kalibrieren: die Spitze bewegt sich wenig um ihre Position und kehrt zurück.</translation>
    </message>
    <message>
        <source>Move x and y by 40 µm around their position and evaluate the pictures</source>
        <translation>x und y um 40 µm um ihre Position bewegen und die Bilder auswerten</translation>
    </message>
    <message>
        <source>Move the tip by 15 µm with the piezos around its position and evaluate the pictures</source>
        <translation>Die Spitze mit den Piezos um 15 µm um ihre Position bewegen und die Bilder auswerten</translation>
    </message>
    <message>
        <source>Stop the machine in place and keep the previous calibration</source>
        <translation>Die Maschine anhalten und die frühere Kalibrierung behalten</translation>
    </message>
    <message>
        <source>For use without a visible pipette, if stage and specimen move together: track the picture itself</source>
        <translation>Ohne sichtbare Pipette, wenn Tisch und Probe sich gemeinsam bewegen: das Bild selbst verfolgen</translation>
    </message>
    <message>
        <source>Objective {objective!r} has no stored calibration.</source>
        <translation>Objektiv {objective!r} hat keine gespeicherte Kalibrierung.</translation>
    </message>
    <message>
        <source>Save the background without the tip in the picture</source>
        <translation>Den Hintergrund speichern, ohne die Spitze im Bild</translation>
    </message>
    <message>
        <source>With Cell, above the picture, a click outlines a cell.</source>
        <translation>Mit „Zelle“ über dem Bild umreißt ein Klick eine Zelle.</translation>
    </message>
    <message>
        <source>Remove cell</source>
        <translation>Zelle verwerfen</translation>
    </message>
    <message>
        <source>Drive for focusing</source>
        <translation>Antrieb zum Fokussieren</translation>
    </message>
    <message>
        <source>Search distance each way, µm</source>
        <translation>Suchweite je Richtung, µm</translation>
    </message>
    <message>
        <source>Find the pipette tip in every picture; to help the search, click it with Tip, above</source>
        <translation>Die Pipettenspitze in jedem Bild finden; ein Klick mit „Spitze“ oben hilft der Suche</translation>
    </message>
    <message>
        <source>Displacement of the background since it was taken</source>
        <translation>Verschiebung des Hintergrunds seit der Aufnahme</translation>
    </message>
    <message>
        <source>Search distance each way from the present position, above 0 µm</source>
        <translation>Suchweite je Richtung von der jetzigen Position, über 0 µm</translation>
    </message>
    <message>
        <source>search distance</source>
        <translation>Suchweite</translation>
    </message>
    <message>
        <source>
{looked} pictures evaluated, {passed} skipped</source>
        <translation>
{looked} Bilder ausgewertet, {passed} übergangen</translation>
    </message>
    <message>
        <source>Save the background without the tip, so that cells do not disturb the tracking; {about}</source>
        <translation>Den Hintergrund ohne die Spitze speichern, damit Zellen die Verfolgung nicht stören; {about}</translation>
    </message>
    <message>
        <source>{activity} is running</source>
        <translation>{activity} läuft</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>{low:g} to {high:g}; 1: linear; smaller values brighten dark regions</source>
        <translation>{low:g} bis {high:g}; 1: linear; kleinere Werte hellen Dunkles auf</translation>
    </message>
    <message>
        <source>the tip is not tracked; click it with Tip, or turn on tracking under Vision</source>
        <translation>die Spitze wird nicht verfolgt; mit „Spitze“ anklicken oder unter Erkennen einschalten</translation>
    </message>
    <message>
        <source>this camera and objective are not calibrated</source>
        <translation>Kamera und Objektiv sind nicht kalibriert</translation>
    </message>
    <message>
        <source>this camera has no such setting</source>
        <translation>diese Kamera hat diese Einstellung nicht</translation>
    </message>
    <message>
        <source>{name}: {text!r} is not a number; enter one in {unit}</source>
        <translation>{name}: {text!r} ist keine Zahl; eine in {unit} eingeben</translation>
    </message>
    <message>
        <source>region: {text!r} is not valid; enter {whole}, or four integers: first column, first row, width and height, px</source>
        <translation>Ausschnitt: {text!r} ist ungültig; {whole} oder vier ganze Zahlen eingeben: erste Spalte, erste Zeile, Breite und Höhe, px</translation>
    </message>
    <message>
        <source>Save this picture: raw values as TIFF, the view as PNG</source>
        <translation>Dieses Bild speichern: Rohwerte als TIFF, Ansicht als PNG</translation>
    </message>
    <message>
        <source>Start and end a video with the recording of the session (panel Recorder)</source>
        <translation>Ein Video mit der Aufnahme der Sitzung beginnen und beenden (Panel Rekorder)</translation>
    </message>
    <message>
        <source>Files are saved to pictures and videos in {data}.</source>
        <translation>Dateien kommen in die Ordner pictures und videos in {data}.</translation>
    </message>
    <message>
        <source>from the robot file</source>
        <translation>laut Roboterdatei</translation>
    </message>
    <message>
        <source>no move: {why}</source>
        <translation>keine Fahrt: {why}</translation>
    </message>
    <message>
        <source>Open this camera and close the present one</source>
        <translation>Diese Kamera öffnen und die jetzige schließen</translation>
    </message>
    <message>
        <source>Objective in use; each has its own calibration. Enter a name to add one</source>
        <translation>Verwendetes Objektiv; jedes hat eine eigene Kalibrierung. Ein neuer Name fügt eines hinzu</translation>
    </message>
    <message>
        <source>no camera is selected or entered</source>
        <translation>keine Kamera ist gewählt oder eingegeben</translation>
    </message>
    <message>
        <source>Read out only the visible region</source>
        <translation>Nur den sichtbaren Ausschnitt auslesen</translation>
    </message>
    <message>
        <source>Read out only the visible region: smaller pictures at a higher rate</source>
        <translation>Nur den sichtbaren Ausschnitt auslesen: kleinere Bilder, höhere Rate</translation>
    </message>
    <message>
        <source>Camera outside the list: source, colon, and a file, folder, stream or number, such as opencv:film.avi or sequence:/data/pictures</source>
        <translation>Nicht gelistete Kamera: Quelle, Doppelpunkt und Datei, Ordner, Stream oder Nummer, etwa opencv:film.avi oder sequence:/data/pictures</translation>
    </message>
    <message>
        <source>Repeat a file or a sequence of pictures</source>
        <translation>Eine Datei oder Bildfolge wiederholen</translation>
    </message>
    <message>
        <source>the camera is free-running</source>
        <translation>die Kamera läuft frei</translation>
    </message>
    <message>
        <source>{text}; open the camera to see its limits</source>
        <translation>{text}; die Grenzen zeigt die geöffnete Kamera</translation>
    </message>
    <message>
        <source>Drag a handle to set the black or the white level</source>
        <translation>Einen Griff ziehen, um den Schwarz- oder Weißpegel zu setzen</translation>
    </message>
    <message>
        <source>Move the tip</source>
        <translation>Die Spitze fahren</translation>
    </message>
    <message>
        <source>Do not move</source>
        <translation>Nicht fahren</translation>
    </message>
    <message>
        <source>Where the tip has been, from above. ◆: saved positions; circles: cells of the list. Red is forbidden, the frame is what the axes can reach.</source>
        <translation>Wo die Spitze war, von oben. ◆: gespeicherte Positionen; Kreise: Zellen der Liste. Rot ist verboten, der Rahmen ist, was die Achsen erreichen.</translation>
    </message>
    <message>
        <source>Click to choose a place; nothing moves. Wheel: zoom. Drag: move the map.</source>
        <translation>Klick: einen Ort wählen; nichts bewegt sich. Rad: zoomen. Ziehen: die Karte verschieben.</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Microscope</source>
        <translation>Mikroskop</translation>
    </message>
</context>
</TS>
