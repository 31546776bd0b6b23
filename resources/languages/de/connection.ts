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
        <source>sample rate</source>
        <translation>Abtastrate</translation>
    </message>
    <message>
        <source>seed</source>
        <translation>Startwert</translation>
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
        <source>{name}; default {default}</source>
        <translation>{name}; Vorgabe {default}</translation>
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
        <source>Line</source>
        <translation>Leitung</translation>
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
        <source>Find the limit switch of {label}</source>
        <translation>Den Endschalter von {label} suchen</translation>
    </message>
    <message>
        <source>Home {label}</source>
        <translation>Referenzfahrt {label}</translation>
    </message>
    <message>
        <source>All positions are known.</source>
        <translation>Alle Positionen sind bekannt.</translation>
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
        <source>nothing is connected</source>
        <translation>nichts ist verbunden</translation>
    </message>
    <message>
        <source>there is no fault</source>
        <translation>es liegt kein Fehler vor</translation>
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
        <source>the parameters differ from the robot file; write or accept them first</source>
        <translation>die Parameter weichen von der Roboterdatei ab; erst schreiben oder übernehmen</translation>
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
        <source>nothing is locked</source>
        <translation>nichts ist gesperrt</translation>
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
        <translation>Boden setzen …</translation>
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
        <source>Set the floor at the current height of the tip; the tip then cannot move below it</source>
        <translation>Den Boden auf die jetzige Höhe der Spitze setzen; die Spitze kann dann nicht tiefer fahren</translation>
    </message>
    <message>
        <source>Remove the floor; only the axis ranges then limit the tip</source>
        <translation>Den Boden entfernen; dann begrenzen nur die Achsbereiche die Spitze</translation>
    </message>
    <message>
        <source>The tip has moved or motion was locked, so no floor was set. Try again when the machine is at rest.</source>
        <translation>Die Spitze hat sich bewegt, oder die Bewegung wurde gesperrt; daher wurde kein Boden gesetzt. In Ruhe erneut versuchen.</translation>
    </message>
    <message>
        <source>it is at {height}</source>
        <translation>liegt er bei {height}</translation>
    </message>
    <message>
        <source>Set the floor at {height}, the current height of the tip? At the moment, {old}.</source>
        <translation>Den Boden auf {height} setzen, die jetzige Höhe der Spitze? Zurzeit: {old}.</translation>
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
        <source>Axis driven by the amplifier</source>
        <translation>Achse, die der Verstärker treibt</translation>
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
        <source>For servicing: ramp the amplifier to this voltage without position feedback</source>
        <translation>Für den Service: den Verstärker ohne Positionsregelung langsam auf diese Spannung fahren</translation>
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
    <message>
        <source>Last stop sent within</source>
        <translation>Letzter Halt gesendet in</translation>
    </message>
    <message>
        <source>Standstill after the last stop</source>
        <translation>Stillstand nach dem letzten Stopp</translation>
    </message>
    <message>
        <source>{name} has no open line.</source>
        <translation>{name} hat keine offene Leitung.</translation>
    </message>
    <message>
        <source>the connection is being opened</source>
        <translation>die Verbindung wird aufgebaut</translation>
    </message>
    <message>
        <source>already connected with these settings</source>
        <translation>schon mit diesen Einstellungen verbunden</translation>
    </message>
    <message>
        <source>already connected</source>
        <translation>schon verbunden</translation>
    </message>
    <message>
        <source>the position is unknown; home first</source>
        <translation>die Position ist unbekannt; erst Referenzfahrt</translation>
    </message>
    <message>
        <source>the position is certain: no connection was lost</source>
        <translation>die Position ist sicher: keine Verbindung ging verloren</translation>
    </message>
    <message>
        <source>there is no previous position</source>
        <translation>es gibt keine frühere Position</translation>
    </message>
    <message>
        <source>the parameters match the robot file or are accepted</source>
        <translation>die Parameter stimmen mit der Roboterdatei überein oder sind übernommen</translation>
    </message>
    <message>
        <source>this robot has no tip for a floor to limit</source>
        <translation>dieser Roboter hat keine Spitze, die ein Boden begrenzen könnte</translation>
    </message>
    <message>
        <source>{name} has no limit switches</source>
        <translation>{name} hat keine Endschalter</translation>
    </message>
    <message>
        <source>{latched} is locked; release it first</source>
        <translation>{latched} ist gesperrt; erst freigeben</translation>
    </message>
    <message>
        <source>{name} stores no parameters</source>
        <translation>{name} speichert keine Parameter</translation>
    </message>
    <message>
        <source>Store the values of the robot file in the device</source>
        <translation>Die Werte der Roboterdatei im Gerät speichern</translation>
    </message>
    <message>
        <source>Use the values of the device until the next connection</source>
        <translation>Bis zur nächsten Verbindung die Werte des Geräts verwenden</translation>
    </message>
    <message>
        <source>{name} stores no parameters.</source>
        <translation>{name} speichert keine Parameter.</translation>
    </message>
    <message>
        <source>The parameters match the robot file.</source>
        <translation>Die Parameter stimmen mit der Roboterdatei überein.</translation>
    </message>
    <message>
        <source>{are} from the robot file; the machine cannot move until you write or accept the values.</source>
        <translation>{are} von der Roboterdatei ab; bis zum Schreiben oder Übernehmen bewegt sich nichts.</translation>
    </message>
    <message>
        <source>there is none</source>
        <translation>gibt es keinen</translation>
    </message>
    <message>
        <source>Set floor</source>
        <translation>Boden setzen</translation>
    </message>
    <message>
        <source>Remove the floor at {height}? Without a floor only the axis ranges limit the tip.</source>
        <translation>Den Boden bei {height} entfernen? Ohne Boden begrenzen nur die Achsbereiche die Spitze.</translation>
    </message>
    <message>
        <source>Stop all axes and block motion until release</source>
        <translation>Alle Achsen anhalten und Bewegung bis zur Freigabe sperren</translation>
    </message>
    <message>
        <source>Release the lock; the machine stays at rest until the next command</source>
        <translation>Die Sperre lösen; die Maschine bleibt bis zum nächsten Befehl in Ruhe</translation>
    </message>
    <message>
        <source>{latched} is already locked</source>
        <translation>{latched} ist schon gesperrt</translation>
    </message>
    <message>
        <source>No position is known.</source>
        <translation>Keine Position ist bekannt.</translation>
    </message>
    <message>
        <source>Find the limit switches of all axes with switches</source>
        <translation>Die Endschalter aller Achsen suchen, die welche haben</translation>
    </message>
    <message>
        <source>Confirm that the machine has not moved since the connection was lost</source>
        <translation>Bestätigen, dass sich die Maschine seit dem Verlust der Verbindung nicht bewegt hat</translation>
    </message>
    <message>
        <source>Return to the position before the latest move: up, across, down</source>
        <translation>Zur Position vor der letzten Bewegung zurückfahren: hoch, quer, ab</translation>
    </message>
    <message>
        <source>Not homed: {axes}</source>
        <translation>Nicht referenziert: {axes}</translation>
    </message>
    <message>
        <source>Device that the program controls: the simulator, boards, or a device of a plugin</source>
        <translation>Gerät, das das Programm steuert: Simulator, Steuerkarten oder Gerät eines Plugins</translation>
    </message>
    <message>
        <source>Connect to {name} again with the same settings</source>
        <translation>Mit denselben Einstellungen wieder mit {name} verbinden</translation>
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
