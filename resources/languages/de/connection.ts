<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>connection</name>
    <message>
        <source>Driver</source>
        <translation>Treiber</translation>
    </message>
    <message>
        <source>What the program drives: the simulator, boards, or a device of a plugin</source>
        <translation>Was das Programm steuert: Simulator, Steuerkarten oder ein Gerät eines Plugins</translation>
    </message>
    <message>
        <source>{name} – cannot be used</source>
        <translation>{name} – nicht benutzbar</translation>
    </message>
    <message>
        <source>Device</source>
        <translation>Gerät</translation>
    </message>
    <message>
        <source>Refresh the ports</source>
        <translation>Anschlüsse neu suchen</translation>
    </message>
    <message>
        <source>Refresh the serial ports</source>
        <translation>Serielle Anschlüsse neu suchen</translation>
    </message>
    <message>
        <source>{name} is left out: {why}</source>
        <translation>{name} fehlt: {why}</translation>
    </message>
    <message>
        <source>Connect</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>Disconnect</source>
        <translation>Trennen</translation>
    </message>
    <message>
        <source>Reconnect</source>
        <translation>Neu verb.</translation>
    </message>
    <message>
        <source>no driver is chosen</source>
        <translation>kein Treiber ist gewählt</translation>
    </message>
    <message>
        <source>Connect to {name}; any other device is disconnected</source>
        <translation>Mit {name} verbinden; jedes andere Gerät wird getrennt</translation>
    </message>
    <message>
        <source>Stop and disconnect the device; it holds its position</source>
        <translation>Anhalten und das Gerät trennen; es hält seine Position</translation>
    </message>
    <message>
        <source>Connect again to {name}, with the settings it had</source>
        <translation>Wieder mit {name} verbinden, mit denselben Einstellungen</translation>
    </message>
    <message>
        <source>sample rate</source>
        <translation>Abtastrate</translation>
    </message>
    <message>
        <source>seed</source>
        <translation>Startzahl</translation>
    </message>
    <message>
        <source>settle</source>
        <translation>Einschwingen</translation>
    </message>
    <message>
        <source>start fraction</source>
        <translation>Startanteil</translation>
    </message>
    <message>
        <source>start homed</source>
        <translation>referenziert starten</translation>
    </message>
    <message>
        <source>port</source>
        <translation>Anschluss</translation>
    </message>
    <message>
        <source>second port</source>
        <translation>zweiter Anschluss</translation>
    </message>
    <message>
        <source>baud</source>
        <translation>Baudrate</translation>
    </message>
    <message>
        <source>watchdog</source>
        <translation>Watchdog</translation>
    </message>
    <message>
        <source>latency</source>
        <translation>Latenz</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keiner</translation>
    </message>
    <message>
        <source>Setting {name}</source>
        <translation>Einstellung {name}</translation>
    </message>
    <message>
        <source>{name}; preset {default!r}</source>
        <translation>{name}; Vorgabe {default!r}</translation>
    </message>
    <message>
        <source>Frames sent</source>
        <translation>Rahmen gesendet</translation>
    </message>
    <message>
        <source>Frames received</source>
        <translation>Rahmen empfangen</translation>
    </message>
    <message>
        <source>Rejected</source>
        <translation>Verworfen</translation>
    </message>
    <message>
        <source>Repeated</source>
        <translation>Wiederholt</translation>
    </message>
    <message>
        <source>Round trip</source>
        <translation>Umlaufzeit</translation>
    </message>
    <message>
        <source>Load</source>
        <translation>Auslastung</translation>
    </message>
    <message>
        <source>Latest</source>
        <translation>Letzter</translation>
    </message>
    <message>
        <source>99.9 % of stops within</source>
        <translation>99,9 % der Halte in</translation>
    </message>
    <message>
        <source>Worst</source>
        <translation>Schlechtester</translation>
    </message>
    <message>
        <source>Last stop handed over in</source>
        <translation>Letzter Halt übergeben in</translation>
    </message>
    <message>
        <source>At rest after</source>
        <translation>In Ruhe nach</translation>
    </message>
    <message>
        <source>Line</source>
        <translation>Leitung</translation>
    </message>
    <message>
        <source>{name} has no line, or has not opened it yet.</source>
        <translation>{name} hat keine Leitung oder hat sie noch nicht geöffnet.</translation>
    </message>
    <message>
        <source>Stop latency</source>
        <translation>Haltelatenz</translation>
    </message>
    <message>
        <source>Parameter</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Robot file</source>
        <translation>Roboterdatei</translation>
    </message>
    <message>
        <source>Parameters</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Parameters that differ</source>
        <translation>Abweichende Parameter</translation>
    </message>
    <message>
        <source>Write to device</source>
        <translation>Ins Gerät schreiben</translation>
    </message>
    <message>
        <source>Accept</source>
        <translation>Übernehmen</translation>
    </message>
    <message>
        <source>One parameter differs</source>
        <translation>Ein Parameter weicht</translation>
    </message>
    <message>
        <source>{count} parameters differ</source>
        <translation>{count} Parameter weichen</translation>
    </message>
    <message>
        <source>{are} from the robot file; nothing moves until that is settled.</source>
        <translation>{are} von der Roboterdatei ab; nichts bewegt sich, bis das geklärt ist.</translation>
    </message>
    <message>
        <source>{name} keeps no parameters of its own.</source>
        <translation>{name} hat keine eigenen Parameter.</translation>
    </message>
    <message>
        <source>Nothing differs from the robot file.</source>
        <translation>Nichts weicht von der Roboterdatei ab.</translation>
    </message>
    <message>
        <source>Write the robot file&apos;s values into the device, which keeps them</source>
        <translation>Die Werte der Roboterdatei ins Gerät schreiben, das sie behält</translation>
    </message>
    <message>
        <source>Move with the device&apos;s own values until it is opened again</source>
        <translation>Mit den Werten des Geräts fahren, bis es neu geöffnet wird</translation>
    </message>
    <message>
        <source>Serial ports cannot be listed: {message}</source>
        <translation>Serielle Anschlüsse nicht auflistbar: {message}</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>Home all</source>
        <translation>Referenzfahrt</translation>
    </message>
    <message>
        <source>Confirm position</source>
        <translation>Position bestätigen</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Find the limit switches of all axes that have some</source>
        <translation>Die Endschalter aller Achsen suchen, die welche haben</translation>
    </message>
    <message>
        <source>Find the limit switch of {label}</source>
        <translation>Den Endschalter von {label} suchen</translation>
    </message>
    <message>
        <source>Confirm that the machine stands where it stood when the connection was lost</source>
        <translation>Bestätigen, dass die Maschine dort steht, wo sie beim Verlust der Verbindung stand</translation>
    </message>
    <message>
        <source>Go back to where the axes rested before the latest move: up, across, down</source>
        <translation>Dorthin zurück, wo die Achsen vor der letzten Bewegung ruhten: hoch, quer, ab</translation>
    </message>
    <message>
        <source>No axis is driven now.</source>
        <translation>Jetzt wird keine Achse gefahren.</translation>
    </message>
    <message>
        <source>Home {label}</source>
        <translation>Referenzfahrt {label}</translation>
    </message>
    <message>
        <source>Unknown, to be homed: {axes}</source>
        <translation>Unbekannt, Referenzfahrt nötig: {axes}</translation>
    </message>
    <message>
        <source>All positions are known.</source>
        <translation>Alle Positionen sind bekannt.</translation>
    </message>
    <message>
        <source>Nothing is known yet.</source>
        <translation>Noch ist nichts bekannt.</translation>
    </message>
    <message>
        <source>it is still connecting</source>
        <translation>die Verbindung wird noch aufgebaut</translation>
    </message>
    <message>
        <source>not connected; connect first</source>
        <translation>nicht verbunden; erst verbinden</translation>
    </message>
    <message>
        <source>the machine is still moving; stop it or wait</source>
        <translation>die Maschine bewegt sich noch; anhalten oder warten</translation>
    </message>
    <message>
        <source>it is connected with these settings</source>
        <translation>es ist mit diesen Einstellungen verbunden</translation>
    </message>
    <message>
        <source>nothing is connected</source>
        <translation>nichts ist verbunden</translation>
    </message>
    <message>
        <source>it is connected</source>
        <translation>es ist verbunden</translation>
    </message>
    <message>
        <source>there is no fault</source>
        <translation>es liegt kein Fehler vor</translation>
    </message>
    <message>
        <source>{name} has no switches to be found</source>
        <translation>{name} hat keine Endschalter</translation>
    </message>
    <message>
        <source>{latched} is latched; release it first</source>
        <translation>{latched} ist eingerastet; erst freigeben</translation>
    </message>
    <message>
        <source>there is a fault; clear it first</source>
        <translation>es liegt ein Fehler vor; erst quittieren</translation>
    </message>
    <message>
        <source>the device does not answer</source>
        <translation>das Gerät antwortet nicht</translation>
    </message>
    <message>
        <source>the position is not known; home first</source>
        <translation>die Position ist unbekannt; erst Referenzfahrt</translation>
    </message>
    <message>
        <source>no lost connection makes the position doubtful</source>
        <translation>keine verlorene Verbindung macht die Position zweifelhaft</translation>
    </message>
    <message>
        <source>there is no move to undo</source>
        <translation>keine Bewegung zum Zurücknehmen</translation>
    </message>
    <message>
        <source>this robot has no tip that a floor could bound</source>
        <translation>dieser Roboter hat keine Spitze, die ein Boden begrenzen könnte</translation>
    </message>
    <message>
        <source>{name} keeps no parameters</source>
        <translation>{name} hat keine Parameter</translation>
    </message>
    <message>
        <source>the device&apos;s parameters are those of the robot file, or accepted</source>
        <translation>die Parameter des Geräts sind die der Roboterdatei oder übernommen</translation>
    </message>
    <message>
        <source>{name} cannot set a voltage</source>
        <translation>{name} kann keine Spannung ausgeben</translation>
    </message>
    <message>
        <source>there is no floor</source>
        <translation>es gibt keinen Boden</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Stop and lock</source>
        <translation>Halt und sperren</translation>
    </message>
    <message>
        <source>Release</source>
        <translation>Freigeben</translation>
    </message>
    <message>
        <source>Clear fault</source>
        <translation>Quittieren</translation>
    </message>
    <message>
        <source>Motion is possible.</source>
        <translation>Bewegung ist möglich.</translation>
    </message>
    <message>
        <source>Locked: {locked}.</source>
        <translation>Gesperrt: {locked}.</translation>
    </message>
    <message>
        <source>{latched} is latched already</source>
        <translation>{latched} ist schon eingerastet</translation>
    </message>
    <message>
        <source>Stop all axes, and let nothing move until it is released</source>
        <translation>Alle Achsen anhalten; nichts bewegt sich bis zur Freigabe</translation>
    </message>
    <message>
        <source>nothing is locked</source>
        <translation>nichts ist gesperrt</translation>
    </message>
    <message>
        <source>Let the machine move again; it stands until it is told to</source>
        <translation>Die Maschine wieder bewegen lassen; sie steht bis zum Befehl</translation>
    </message>
    <message>
        <source>Acknowledge the device&apos;s fault</source>
        <translation>Den Fehler des Geräts quittieren</translation>
    </message>
    <message>
        <source>Tip height</source>
        <translation>Höhe der Spitze</translation>
    </message>
    <message>
        <source>Floor</source>
        <translation>Boden</translation>
    </message>
    <message>
        <source>Above the floor</source>
        <translation>Über dem Boden</translation>
    </message>
    <message>
        <source>Tip</source>
        <translation>Spitze</translation>
    </message>
    <message>
        <source>Teach floor …</source>
        <translation>Boden lernen …</translation>
    </message>
    <message>
        <source>Remove floor …</source>
        <translation>Boden löschen …</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>unbekannt</translation>
    </message>
    <message>
        <source>Set the floor where the tip is now; nothing moves below it</source>
        <translation>Den Boden dorthin legen, wo die Spitze jetzt ist; darunter bewegt sich nichts</translation>
    </message>
    <message>
        <source>Let the tip go as low as its axes can</source>
        <translation>Die Spitze so tief lassen, wie ihre Achsen reichen</translation>
    </message>
    <message>
        <source>The tip has moved: no floor was taught. Ask again where it rests.</source>
        <translation>Die Spitze hat sich bewegt: Kein Boden wurde gelernt. Nochmals fragen, wenn sie ruht.</translation>
    </message>
    <message>
        <source>there is none yet</source>
        <translation>gibt es keinen</translation>
    </message>
    <message>
        <source>it is at {height}</source>
        <translation>liegt er bei {height}</translation>
    </message>
    <message>
        <source>Put the floor at {height}, where the tip is now? So far {old}.</source>
        <translation>Den Boden auf {height} legen, wo die Spitze jetzt ist? Bisher {old}.</translation>
    </message>
    <message>
        <source>Teach</source>
        <translation>Lernen</translation>
    </message>
    <message>
        <source>Take the floor at {height} away? New floor: none; only the ranges of the axes hold the tip then.</source>
        <translation>Den Boden bei {height} entfernen? Neuer Boden: keiner; dann begrenzen nur die Achsbereiche die Spitze.</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Amplifier voltage</source>
        <translation>Spannung des Verstärkers</translation>
    </message>
    <message>
        <source>Axis of the amplifier</source>
        <translation>Achse des Verstärkers</translation>
    </message>
    <message>
        <source>Voltage</source>
        <translation>Spannung</translation>
    </message>
    <message>
        <source>Apply …</source>
        <translation>Anlegen …</translation>
    </message>
    <message>
        <source>For service: apply this voltage slowly, whatever position it leads to</source>
        <translation>Für den Service: diese Spannung langsam anlegen, zu welcher Position sie auch führt</translation>
    </message>
    <message>
        <source>{low} to {high} V</source>
        <translation>{low} bis {high} V</translation>
    </message>
    <message>
        <source>Apply {volts:g} V to {axis}? The axis moves slowly to about {position}.</source>
        <translation>{volts:g} V an {axis} anlegen? Die Achse fährt langsam auf etwa {position}.</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Anlegen</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Connection</source>
        <translation>Verbindung</translation>
    </message>
</context>
</TS>
