<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>events</name>
    <message>
        <source>Recording {name} begins</source>
        <translation>Aufzeichnung {name} beginnt</translation>
    </message>
    <message>
        <source>Recording {name} ends</source>
        <translation>Aufzeichnung {name} endet</translation>
    </message>
    <message>
        <source>Model in use: {name}</source>
        <translation>Modell im Einsatz: {name}</translation>
    </message>
    <message>
        <source>Connected: {name}</source>
        <translation>Verbunden: {name}</translation>
    </message>
    <message>
        <source>Disconnected</source>
        <translation>Getrennt</translation>
    </message>
    <message>
        <source>The lock is released</source>
        <translation>Die Sperre ist aufgehoben</translation>
    </message>
    <message>
        <source>Stopped and locked by the operator</source>
        <translation>Vom Bediener gestoppt und gesperrt</translation>
    </message>
    <message>
        <source>Stopped by the operator</source>
        <translation>Vom Bediener gestoppt</translation>
    </message>
    <message>
        <source>Stopped by the program</source>
        <translation>Vom Programm gestoppt</translation>
    </message>
    <message>
        <source>Locked: {why}</source>
        <translation>Gesperrt: {why}</translation>
    </message>
    <message>
        <source>Motion is possible</source>
        <translation>Bewegung ist möglich</translation>
    </message>
    <message>
        <source>a trajectory</source>
        <translation>eine Trajektorie</translation>
    </message>
    <message>
        <source>Plays {name}</source>
        <translation>Spielt {name}</translation>
    </message>
    <message>
        <source>{name} is paused at row {row}</source>
        <translation>{name}: Pause bei Zeile {row}</translation>
    </message>
    <message>
        <source>{name} has ended</source>
        <translation>{name} ist beendet</translation>
    </message>
    <message>
        <source>{name} goes on at row {row}</source>
        <translation>{name} geht bei Zeile {row} weiter</translation>
    </message>
    <message>
        <source>Penetration: {phase}</source>
        <translation>Penetration: {phase}</translation>
    </message>
    <message>
        <source>Homed: {moved}</source>
        <translation>Referenziert: {moved}</translation>
    </message>
    <message>
        <source>Events, newest first</source>
        <translation>Ereignisse, die neuesten zuerst</translation>
    </message>
    <message>
        <source>Show log</source>
        <translation>Protokoll zeigen</translation>
    </message>
    <message>
        <source>All that the program told, to be filtered and copied (Ctrl+L)</source>
        <translation>Alles, was das Programm gemeldet hat, zum Filtern und Kopieren (Strg+L)</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Events</source>
        <translation>Ereignisse</translation>
    </message>
</context>
</TS>
