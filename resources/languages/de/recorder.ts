<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>panels</name>
    <message>
        <source>Recorder</source>
        <translation>Rekorder</translation>
    </message>
</context>
<context>
    <name>recorder</name>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>Text</source>
        <translation>Text</translation>
    </message>
    <message>
        <source>Fault</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Halt</translation>
    </message>
    <message>
        <source>Refused</source>
        <translation>Abgelehnt</translation>
    </message>
    <message>
        <source>Recorder</source>
        <translation>Rekorder</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Vermerk</translation>
    </message>
    <message>
        <source>Action</source>
        <translation>Aktion</translation>
    </message>
    <message>
        <source>Playback begins</source>
        <translation>Wiedergabe beginnt</translation>
    </message>
    <message>
        <source>Playback ends</source>
        <translation>Wiedergabe endet</translation>
    </message>
    <message>
        <source>Connection</source>
        <translation>Verbindung</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Log</source>
        <translation>Protokoll</translation>
    </message>
    <message>
        <source>Open a recording to see what happened in it.</source>
        <translation>Eine Aufnahme öffnen, um ihre Ereignisse zu sehen.</translation>
    </message>
    <message>
        <source>with states and log lines</source>
        <translation>mit Zuständen und Protokoll</translation>
    </message>
    <message>
        <source>Show these too, beside what the operator did and was told</source>
        <translation>Auch diese zeigen, neben Handlungen und Meldungen</translation>
    </message>
    <message>
        <source>{name}: {n} of {all} events; click to jump</source>
        <translation>{name}: {n} von {all} Ereignissen; Klick springt hin</translation>
    </message>
    <message>
        <source>Events of the recording that is shown</source>
        <translation>Ereignisse der gezeigten Aufnahme</translation>
    </message>
    <message>
        <source>Recover</source>
        <translation>Retten</translation>
    </message>
    <message>
        <source>Make finished recordings of all that was recorded of them</source>
        <translation>Aus allem, was davon aufgenommen wurde, fertige Aufnahmen machen</translation>
    </message>
    <message>
        <source>Recovering …</source>
        <translation>Wird gerettet …</translation>
    </message>
    <message>
        <source>Recovering {names} …</source>
        <translation>{names} wird gerettet …</translation>
    </message>
    <message>
        <source>Recovered {names}</source>
        <translation>Gerettet: {names}</translation>
    </message>
    <message>
        <source>{folder}: cannot be read ({reason})</source>
        <translation>{folder}: nicht lesbar ({reason})</translation>
    </message>
    <message>
        <source>What is shown</source>
        <translation>Was gezeigt wird</translation>
    </message>
    <message>
        <source>Records</source>
        <translation>Aufzeichnungen</translation>
    </message>
    <message>
        <source>Events</source>
        <translation>Ereignisse</translation>
    </message>
    <message>
        <source>Recordings that were cut off: {names}. Recover them in the panel {title}.</source>
        <translation>Abgebrochene Aufnahmen: {names}. Im Panel {title} zu retten.</translation>
    </message>
    <message>
        <source>● Record</source>
        <translation>● Aufnehmen</translation>
    </message>
    <message>
        <source>Time since the recording began</source>
        <translation>Zeit seit Beginn der Aufnahme</translation>
    </message>
    <message>
        <source>remark</source>
        <translation>Bemerkung</translation>
    </message>
    <message>
        <source>Remark for the recording</source>
        <translation>Bemerkung zur Aufnahme</translation>
    </message>
    <message>
        <source>Written into the recording with the time of Enter</source>
        <translation>Kommt mit der Zeit von Enter in die Aufnahme</translation>
    </message>
    <message>
        <source>Write the remark into the recording</source>
        <translation>Die Bemerkung in die Aufnahme schreiben</translation>
    </message>
    <message>
        <source>Record from program start</source>
        <translation>Ab jedem Start aufnehmen</translation>
    </message>
    <message>
        <source>Begin a recording by itself when the program is started</source>
        <translation>Beim Start des Programms von selbst eine Aufnahme beginnen</translation>
    </message>
    <message>
        <source>Folder of recordings</source>
        <translation>Ordner der Aufnahmen</translation>
    </message>
    <message>
        <source>The folder of recordings, to be copied</source>
        <translation>Der Ordner der Aufnahmen, zum Kopieren</translation>
    </message>
    <message>
        <source>File</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Free</source>
        <translation>Frei</translation>
    </message>
    <message>
        <source>Recording: {what}</source>
        <translation>Aufnahme: {what}</translation>
    </message>
    <message>
        <source>■ End recording</source>
        <translation>■ Aufnahme beenden</translation>
    </message>
    <message>
        <source>End it and keep it in one file</source>
        <translation>Beenden und in einer Datei behalten</translation>
    </message>
    <message>
        <source>Record everything from now on</source>
        <translation>Ab jetzt alles aufnehmen</translation>
    </message>
    <message>
        <source>wait until that is done</source>
        <translation>warten, bis das fertig ist</translation>
    </message>
    <message>
        <source>nothing is being recorded</source>
        <translation>es wird nichts aufgenommen</translation>
    </message>
    <message>
        <source>Enter puts it into the recording, at this time</source>
        <translation>Enter schreibt sie mit dieser Zeit in die Aufnahme</translation>
    </message>
    <message>
        <source>Add the remark to the recording at this time</source>
        <translation>Die Bemerkung mit dieser Zeit in die Aufnahme schreiben</translation>
    </message>
    <message>
        <source>Nothing is recorded now: {failure}. Make room; motion goes on.</source>
        <translation>Jetzt wird nichts aufgenommen: {failure}. Platz schaffen; die Bewegung läuft weiter.</translation>
    </message>
    <message>
        <source>Beginning …</source>
        <translation>Beginnt …</translation>
    </message>
    <message>
        <source>Beginning to record …</source>
        <translation>Die Aufnahme beginnt …</translation>
    </message>
    <message>
        <source>Ending …</source>
        <translation>Endet …</translation>
    </message>
    <message>
        <source>Ending the recording: {size} are put together …</source>
        <translation>Die Aufnahme endet: {size} werden zusammengestellt …</translation>
    </message>
    <message>
        <source>Recorded {path}</source>
        <translation>Aufgenommen: {path}</translation>
    </message>
    <message>
        <source>{target}: it is the recording itself; name another file</source>
        <translation>{target}: das ist die Aufnahme selbst; eine andere Datei nennen</translation>
    </message>
    <message>
        <source>Exported {target}: {rows} rows</source>
        <translation>Exportiert: {target}, {rows} Zeilen</translation>
    </message>
    <message>
        <source>Exporting {name} …</source>
        <translation>{name} wird exportiert …</translation>
    </message>
    <message>
        <source>{stem} again</source>
        <translation>{stem} nochmals</translation>
    </message>
    <message>
        <source>Reading the commands of {name} …</source>
        <translation>Die Sollwerte von {name} werden gelesen …</translation>
    </message>
    <message>
        <source>Replay</source>
        <translation>Zeigen</translation>
    </message>
    <message>
        <source>Export …</source>
        <translation>Export …</translation>
    </message>
    <message>
        <source>To trajectory</source>
        <translation>Trajektorie</translation>
    </message>
    <message>
        <source>Refresh</source>
        <translation>Neu suchen</translation>
    </message>
    <message>
        <source>choose one record in the table</source>
        <translation>eine Aufzeichnung in der Tabelle wählen</translation>
    </message>
    <message>
        <source>▏Here</source>
        <translation>▏Hier</translation>
    </message>
    <message>
        <source>Here▕</source>
        <translation>Hier▕</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Mehr</translation>
    </message>
    <message>
        <source>Run report, change name or note, find or open a file, delete</source>
        <translation>Laufbericht, Name oder Notiz ändern, Datei suchen oder öffnen, löschen</translation>
    </message>
    <message>
        <source>Change name</source>
        <translation>Name ändern</translation>
    </message>
    <message>
        <source>Change note</source>
        <translation>Notiz ändern</translation>
    </message>
    <message>
        <source>Find file …</source>
        <translation>Datei suchen …</translation>
    </message>
    <message>
        <source>Replay other file …</source>
        <translation>Andere Datei zeigen …</translation>
    </message>
    <message>
        <source>Delete …</source>
        <translation>Löschen …</translation>
    </message>
    <message>
        <source>From</source>
        <translation>Von</translation>
    </message>
    <message>
        <source>to</source>
        <translation>bis</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>Vergleichen</translation>
    </message>
    <message>
        <source>Show the recording in place of the machine</source>
        <translation>Die Aufnahme anstelle der Maschine zeigen</translation>
    </message>
    <message>
        <source>Compare the record with the model in use</source>
        <translation>Die Aufzeichnung mit dem benutzten Modell vergleichen</translation>
    </message>
    <message>
        <source>Write the stretch as an ASCII record, to be compared and diagnosed</source>
        <translation>Den Abschnitt als ASCII-Aufzeichnung schreiben, zum Vergleichen und Diagnostizieren</translation>
    </message>
    <message>
        <source>Take the commands of the stretch in hand, to be played on the machine; every axis must stand at both ends</source>
        <translation>Die Sollwerte des Abschnitts als Trajektorie übernehmen; jede Achse muss an beiden Enden stehen</translation>
    </message>
    <message>
        <source>this recording is not shown</source>
        <translation>diese Aufnahme wird nicht gezeigt</translation>
    </message>
    <message>
        <source>Let the stretch begin where the replay is</source>
        <translation>Den Abschnitt beginnen lassen, wo die Wiedergabe ist</translation>
    </message>
    <message>
        <source>Let the stretch end where the replay is</source>
        <translation>Den Abschnitt enden lassen, wo die Wiedergabe ist</translation>
    </message>
    <message>
        <source>Export a record</source>
        <translation>Aufzeichnung exportieren</translation>
    </message>
    <message>
        <source>Records (*.csv *.csv.gz)</source>
        <translation>Aufzeichnungen (*.csv *.csv.gz)</translation>
    </message>
    <message>
        <source>Recordings (*{suffix});;All files (*)</source>
        <translation>Aufnahmen (*{suffix});;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Where is {name}?</source>
        <translation>Wo ist {name}?</translation>
    </message>
    <message>
        <source>Delete {names}? This deletes {size} on the disk for good. Files in other folders stay; they only leave the list.</source>
        <translation>{names} löschen? Dies löscht {size} endgültig vom Datenträger. Dateien in anderen Ordnern bleiben; sie verlassen nur die Liste.</translation>
    </message>
    <message>
        <source>{names} and {n} more</source>
        <translation>{names} und {n} weitere</translation>
    </message>
    <message>
        <source>it is a record already; only a recording is exported</source>
        <translation>es ist schon eine Aufzeichnung; nur eine Aufnahme wird exportiert</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Löschen</translation>
    </message>
    <message>
        <source>{end} of the stretch in seconds</source>
        <translation>{end} des Abschnitts in Sekunden</translation>
    </message>
    <message>
        <source>Seconds from the begin of the recording; empty: its {end}</source>
        <translation>Sekunden ab Beginn der Aufnahme; leer: ihr {end}</translation>
    </message>
    <message>
        <source>begin</source>
        <translation>Beginn</translation>
    </message>
    <message>
        <source>end</source>
        <translation>Ende</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>unbekannt</translation>
    </message>
    <message>
        <source>{n:.0f} days</source>
        <translation>{n:.0f} Tage</translation>
    </message>
    <message>
        <source>{hours:.1f} h</source>
        <translation>{hours:.1f} h</translation>
    </message>
    <message>
        <source>{size}, for {left}</source>
        <translation>{size}, für {left}</translation>
    </message>
    <message>
        <source>Only {free} are free, and ending the recording takes {size}: make room. Motion goes on in any case.</source>
        <translation>Nur {free} sind frei, und das Beenden der Aufnahme braucht {size}: Platz schaffen. Die Bewegung läuft auf jeden Fall weiter.</translation>
    </message>
    <message>
        <source>Not ended, as the program or its computer was cut off: {names}.</source>
        <translation>Nicht beendet, weil Programm oder Rechner ausfielen: {names}.</translation>
    </message>
    <message>
        <source>{name} is being recorded by another program.</source>
        <translation>{name} wird von einem anderen Programm aufgenommen.</translation>
    </message>
    <message>
        <source> and {n} more</source>
        <translation> und {n} weitere</translation>
    </message>
    <message>
        <source>from {begin:g} s to {end:g} s: the end must be later than the begin</source>
        <translation>von {begin:g} s bis {end:g} s: das Ende muss nach dem Beginn liegen</translation>
    </message>
    <message>
        <source>from {begin:g} s: the recording lasts {duration:.3f} s</source>
        <translation>ab {begin:g} s: die Aufnahme dauert {duration:.3f} s</translation>
    </message>
    <message>
        <source>{text!r} is no {what}: type seconds from the begin of the recording, 0 or more, with a decimal point, or nothing</source>
        <translation>{text!r} ist kein {what}: Sekunden ab Beginn der Aufnahme eingeben, 0 oder mehr, mit Dezimalkomma, oder nichts</translation>
    </message>
    <message>
        <source>Run</source>
        <translation>Lauf</translation>
    </message>
    <message>
        <source>Operator</source>
        <translation>Bediener</translation>
    </message>
    <message>
        <source>Sample</source>
        <translation>Probe</translation>
    </message>
    <message>
        <source>Stands in every playback and recording from now on</source>
        <translation>Steht von jetzt an in jeder Wiedergabe und Aufnahme</translation>
    </message>
</context>
</TS>
