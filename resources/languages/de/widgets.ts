<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>shell</name>
    <message>
        <source>time [s]</source>
        <extracomment>Line styles of all plots and themes. Two lines that colour-blind users could confuse differ in their dashes. Dense noise is slow to draw if it is wider than 1 px or dashed, so measured signals use the plain style.</extracomment>
        <translation>Zeit [s]</translation>
    </message>
</context>
<context>
    <name>widgets</name>
    <message>
        <source>Not now: {why_not}</source>
        <translation>Nicht jetzt: {why_not}</translation>
    </message>
    <message>
        <source>Yes</source>
        <translation>Ja</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Confirm</source>
        <translation>Bestätigen</translation>
    </message>
    <message>
        <source>Change nothing</source>
        <translation>Nichts ändern</translation>
    </message>
    <message>
        <source>{title}, has something new</source>
        <translation>{title}, enthält Neues</translation>
    </message>
</context>
</TS>
