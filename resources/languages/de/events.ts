<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>events</name>
    <message>
        <source>Model in use: {name}</source>
        <translation>Verwendetes Modell: {name}</translation>
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
        <source>Stopped and locked by the operator</source>
        <translation>Vom Bediener angehalten und gesperrt</translation>
    </message>
    <message>
        <source>Stopped by the operator</source>
        <translation>Vom Bediener angehalten</translation>
    </message>
    <message>
        <source>Stopped by the program</source>
        <translation>Vom Programm angehalten</translation>
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
        <source>{name} is paused at row {row}</source>
        <translation>{name}: Pause bei Zeile {row}</translation>
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
        <source>All messages of the program, with filter and copy (Ctrl+L)</source>
        <translation>Alle Meldungen des Programms, zum Filtern und Kopieren (Strg+L)</translation>
    </message>
    <message>
        <source>{name} resumed at row {row}</source>
        <translation>{name}: weiter bei Zeile {row}</translation>
    </message>
    <message>
        <source>Lock released</source>
        <translation>Sperre gelöst</translation>
    </message>
    <message>
        <source>Playing {name}</source>
        <translation>Spielt {name} ab</translation>
    </message>
    <message>
        <source>{name} ended</source>
        <translation>{name} beendet</translation>
    </message>
    <message>
        <source>Recording {name} started</source>
        <translation>Aufnahme {name} begonnen</translation>
    </message>
    <message>
        <source>Recording {name} ended</source>
        <translation>Aufnahme {name} beendet</translation>
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
