<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>panels</name>
    <message>
        <source>Comparison of model and real</source>
        <translation>Vergleich Modell – Maschine</translation>
    </message>
</context>
</TS>
