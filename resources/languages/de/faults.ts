<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>faults</name>
    <message>
        <source>the virtual board ended by itself</source>
        <translation>die virtuelle Steuerkarte endete von selbst</translation>
    </message>
    <message>
        <source>all lines</source>
        <translation>alle</translation>
    </message>
    <message>
        <source>line {n}</source>
        <translation>Leitung {n}</translation>
    </message>
    <message>
        <source>Line</source>
        <translation>Leitung</translation>
    </message>
    <message>
        <source>board {n}</source>
        <translation>Karte {n}</translation>
    </message>
    <message>
        <source>lose</source>
        <translation>verlieren</translation>
    </message>
    <message>
        <source>double</source>
        <translation>doppeln</translation>
    </message>
    <message>
        <source>corrupt</source>
        <translation>stören</translation>
    </message>
    <message>
        <source>add</source>
        <translation>einfügen</translation>
    </message>
    <message>
        <source>Direction</source>
        <translation>Richtung</translation>
    </message>
    <message>
        <source>to board</source>
        <translation>zur Karte</translation>
    </message>
    <message>
        <source>to program</source>
        <translation>zum PC</translation>
    </message>
    <message>
        <source>Bytes</source>
        <translation>Bytes</translation>
    </message>
    <message>
        <source>Delay</source>
        <translation>Verzug</translation>
    </message>
    <message>
        <source>delay</source>
        <translation>verzögern</translation>
    </message>
    <message>
        <source>Cable</source>
        <translation>Kabel</translation>
    </message>
    <message>
        <source>silent</source>
        <translation>stumm</translation>
    </message>
    <message>
        <source>held at space</source>
        <translation>Dauer-Null</translation>
    </message>
    <message>
        <source>Duration</source>
        <translation>Dauer</translation>
    </message>
    <message>
        <source>Board</source>
        <translation>Karte</translation>
    </message>
    <message>
        <source>reset</source>
        <translation>Reset</translation>
    </message>
    <message>
        <source>brown-out</source>
        <translation>Unterspannung</translation>
    </message>
    <message>
        <source>Sensor</source>
        <translation>Sensor</translation>
    </message>
    <message>
        <source>freeze</source>
        <translation>einfrieren</translation>
    </message>
    <message>
        <source>Microsteps</source>
        <translation>Mikroschritte</translation>
    </message>
    <message>
        <source>lose steps</source>
        <translation>Schritte verlieren</translation>
    </message>
    <message>
        <source>Stepper</source>
        <translation>Stepper</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>fault</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>verloren</translation>
    </message>
    <message>
        <source>not connected</source>
        <translation>nicht verbunden</translation>
    </message>
    <message>
        <source>refused</source>
        <translation>abgelehnt</translation>
    </message>
    <message>
        <source>recovered</source>
        <translation>behoben</translation>
    </message>
    <message>
        <source>stop and lock</source>
        <translation>Halt und sperren</translation>
    </message>
    <message>
        <source>injected</source>
        <translation>eingespeist</translation>
    </message>
    <message>
        <source>note</source>
        <translation>Hinweis</translation>
    </message>
    <message>
        <source>{text} ({n} times)</source>
        <translation>{text} ({n}-mal)</translation>
    </message>
    <message>
        <source>released</source>
        <translation>freigegeben</translation>
    </message>
    <message>
        <source>connected</source>
        <translation>verbunden</translation>
    </message>
    <message>
        <source>disconnected</source>
        <translation>getrennt</translation>
    </message>
    <message>
        <source>the device has briefly stopped responding</source>
        <translation>das Gerät antwortet kurz nicht</translation>
    </message>
    <message>
        <source>the device answers again</source>
        <translation>das Gerät antwortet wieder</translation>
    </message>
    <message>
        <source>cleared: {about}</source>
        <translation>quittiert: {about}</translation>
    </message>
    <message>
        <source>Inject</source>
        <translation>Einspeisen</translation>
    </message>
    <message>
        <source>Inject {fault}</source>
        <translation>{fault} einspeisen</translation>
    </message>
    <message>
        <source>{low:g} to {high:.7g} {unit}</source>
        <translation>{low:g} bis {high:.7g} {unit}</translation>
    </message>
    <message>
        <source>Lines of the virtual board</source>
        <translation>Leitungen der virtuellen Steuerkarte</translation>
    </message>
    <message>
        <source>Whether the virtual boards share one serial line</source>
        <translation>Ob sich die virtuellen Steuerkarten eine serielle Leitung teilen</translation>
    </message>
    <message>
        <source>a line for each board</source>
        <translation>eine Leitung je Karte</translation>
    </message>
    <message>
        <source>one line</source>
        <translation>eine Leitung</translation>
    </message>
    <message>
        <source>one shared line</source>
        <translation>eine gemeinsame Leitung</translation>
    </message>
    <message>
        <source>Position known</source>
        <translation>Position bekannt</translation>
    </message>
    <message>
        <source>Start virtual board</source>
        <translation>Virtuelle Karte starten</translation>
    </message>
    <message>
        <source>End</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>End the virtual board</source>
        <translation>Virtuelle Steuerkarte beenden</translation>
    </message>
    <message>
        <source>virtual {board}</source>
        <translation>virtuell: {board}</translation>
    </message>
    <message>
        <source>virtual board on {about}</source>
        <translation>virtuelle Steuerkarte an {about}</translation>
    </message>
    <message>
        <source>virtual board ended</source>
        <translation>virtuelle Steuerkarte beendet</translation>
    </message>
    <message>
        <source>virtual board ended: {about}</source>
        <translation>virtuelle Steuerkarte beendet: {about}</translation>
    </message>
    <message>
        <source>Starting …</source>
        <translation>Startet …</translation>
    </message>
    <message>
        <source>Start boards of this robot</source>
        <translation>Steuerkarten dieses Roboters starten</translation>
    </message>
    <message>
        <source>Clear fault</source>
        <translation>Quittieren</translation>
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
        <source>Acknowledge the device&apos;s fault</source>
        <translation>Den Fehler des Geräts quittieren</translation>
    </message>
    <message>
        <source>Save faults</source>
        <translation>Fehler speichern</translation>
    </message>
    <message>
        <source>Text (*.txt)</source>
        <translation>Text (*.txt)</translation>
    </message>
    <message>
        <source>there is no fault</source>
        <translation>es gibt keinen Fehler</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Reason</source>
        <translation>Grund</translation>
    </message>
    <message>
        <source>no virtual board is running; start it first</source>
        <translation>keine virtuelle Steuerkarte läuft; zuerst starten</translation>
    </message>
    <message>
        <source>on this system a virtual board accepts no commands</source>
        <translation>auf diesem System nimmt eine virtuelle Steuerkarte keine Befehle an</translation>
    </message>
    <message>
        <source>Start homed and without a fault, unlike a real board</source>
        <translation>Referenziert und ohne Fehler beginnen, anders als eine echte Karte</translation>
    </message>
    <message>
        <source>End the virtual board; its lines fall silent</source>
        <translation>Die virtuelle Karte beenden; ihre Leitungen verstummen</translation>
    </message>
    <message>
        <source>No virtual board is running.</source>
        <translation>Keine virtuelle Steuerkarte läuft.</translation>
    </message>
    <message>
        <source>For training: start a virtual board, connect to its ports, and inject faults. The virtual board runs as a separate process. The built-in simulator has neither lines nor boards that could fail; set the effects of its machine in the Effects panel.</source>
        <translation>Zum Üben: Starten Sie eine virtuelle Karte, verbinden Sie sich mit ihren Anschlüssen und speisen Sie Fehler ein. Die virtuelle Karte läuft als eigener Prozess. Der eingebaute Simulator hat weder Leitungen noch Karten, die ausfallen könnten; die Effekte seiner Maschine stellen Sie im Fenster Effekte ein.</translation>
    </message>
    <message>
        <source>it is already running</source>
        <translation>sie läuft schon</translation>
    </message>
    <message>
        <source>Listening on {ports}; connect to it.</source>
        <translation>Lauscht an {ports}; damit verbinden.</translation>
    </message>
    <message>
        <source>{about} locked</source>
        <translation>gesperrt: {about}</translation>
    </message>
    <message>
        <source>The next bytes are lost, doubled or corrupted by one bit, or extra bytes arrive</source>
        <translation>Die nächsten Bytes gehen verloren, kommen doppelt oder mit einem falschen Bit, oder es kommen zusätzliche</translation>
    </message>
    <message>
        <source>Delay all bytes by this time; 0 ends the delay</source>
        <translation>Alle Bytes um diese Zeit verzögern; 0 beendet es</translation>
    </message>
    <message>
        <source>The line transmits nothing in either direction; held at space, the boards receive a stop first</source>
        <translation>Die Leitung überträgt in keiner Richtung; auf Dauer-Null empfangen die Karten zuerst einen Halt</translation>
    </message>
    <message>
        <source>A board restarts and loses the positions of its steppers</source>
        <translation>Eine Karte startet neu und verliert die Positionen ihrer Schrittmotoren</translation>
    </message>
    <message>
        <source>A sensor repeats one reading until released</source>
        <translation>Ein Sensor wiederholt einen Messwert, bis er freigegeben wird</translation>
    </message>
    <message>
        <source>Fault</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>The stepper falls behind its command</source>
        <translation>Der Schrittmotor bleibt hinter seinem Sollwert zurück</translation>
    </message>
    <message>
        <source>release</source>
        <translation>freigeben</translation>
    </message>
    <message>
        <source>Clear</source>
        <translation>Leeren</translation>
    </message>
    <message>
        <source>the list is empty</source>
        <translation>die Liste ist leer</translation>
    </message>
    <message>
        <source>Copy the selected rows, or all rows, as text (Ctrl+C)</source>
        <translation>Die gewählten oder alle Zeilen als Text kopieren (Strg+C)</translation>
    </message>
    <message>
        <source>Write all rows to a text file</source>
        <translation>Alle Zeilen in eine Textdatei schreiben</translation>
    </message>
    <message>
        <source>Clear all rows</source>
        <translation>Alle Zeilen löschen</translation>
    </message>
    <message>
        <source>not connected; reconnect in the Connection panel</source>
        <translation>nicht verbunden; im Fenster Verbindung neu verbinden</translation>
    </message>
    <message>
        <source>Faults, newest first</source>
        <translation>Fehler, die neuesten zuerst</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Faults</source>
        <translation>Fehler</translation>
    </message>
</context>
</TS>
