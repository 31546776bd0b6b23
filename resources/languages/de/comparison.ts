<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>comparison</name>
    <message>
        <source>without offset</source>
        <translation>ohne Versatz</translation>
    </message>
    <message>
        <source>nominal</source>
        <translation>nominal</translation>
    </message>
    <message>
        <source>noise floor</source>
        <translation>Rauschgrenze</translation>
    </message>
    <message>
        <source>rel. error</source>
        <translation>rel. Fehler</translation>
    </message>
    <message>
        <source>delay</source>
        <translation>Totzeit</translation>
    </message>
    <message>
        <source>Open record …</source>
        <translation>Aufzeichnung öffnen …</translation>
    </message>
    <message>
        <source>Compare a record of the real machine with the model (Ctrl+O)</source>
        <translation>Eine Aufzeichnung der Maschine mit dem Modell vergleichen (Strg+O)</translation>
    </message>
    <message>
        <source>Save record …</source>
        <translation>Aufzeichnung speichern …</translation>
    </message>
    <message>
        <source>no record is open; play a trajectory or open one</source>
        <translation>keine Aufzeichnung ist geöffnet; eine Trajektorie abspielen oder eine Aufzeichnung öffnen</translation>
    </message>
    <message>
        <source>Signals and their gaps</source>
        <translation>Signale und ihre Abweichungen</translation>
    </message>
    <message>
        <source>, stopped early</source>
        <translation>, vorzeitig angehalten</translation>
    </message>
    <message>
        <source>{name}: {duration:.3f} s, {n} samples{state}</source>
        <translation>{name}: {duration:.3f} s, {n} Messwerte{state}</translation>
    </message>
    <message>
        <source>real</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>model in use</source>
        <translation>verwendetes Modell</translation>
    </message>
    <message>
        <source>real − model [{symbol}]</source>
        <translation>Maschine − Modell [{symbol}]</translation>
    </message>
    <message>
        <source>Play a trajectory or open a record of the real machine to compare it with the model.</source>
        <translation>Eine Trajektorie abspielen oder eine Aufzeichnung der echten Maschine öffnen, um sie mit dem Modell zu vergleichen.</translation>
    </message>
    <message>
        <source>signal</source>
        <translation>Signal</translation>
    </message>
    <message>
        <source>Save the current record to a file (Ctrl+S)</source>
        <translation>Die aktuelle Aufzeichnung in einer Datei speichern (Strg+S)</translation>
    </message>
</context>
<context>
    <name>panels</name>
    <message>
        <source>Comparison of model and machine</source>
        <translation>Vergleich Modell – Maschine</translation>
    </message>
</context>
</TS>
