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
        <source>Recover</source>
        <translation>Wiederherstellen</translation>
    </message>
    <message>
        <source>Recovering …</source>
        <translation>Wird wiederhergestellt …</translation>
    </message>
    <message>
        <source>Recovering {names} …</source>
        <translation>{names}: wird wiederhergestellt …</translation>
    </message>
    <message>
        <source>Recovered {names}</source>
        <translation>Wiederhergestellt: {names}</translation>
    </message>
    <message>
        <source>{folder}: cannot be read ({reason})</source>
        <translation>{folder}: nicht lesbar ({reason})</translation>
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
        <source>Write the remark into the recording</source>
        <translation>Die Bemerkung in die Aufnahme schreiben</translation>
    </message>
    <message>
        <source>Record from program start</source>
        <translation>Ab jedem Start aufnehmen</translation>
    </message>
    <message>
        <source>Folder of recordings</source>
        <translation>Ordner der Aufnahmen</translation>
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
        <source>nothing is being recorded</source>
        <translation>es wird nichts aufgenommen</translation>
    </message>
    <message>
        <source>The recording has ended already.</source>
        <translation>Die Aufnahme ist schon beendet.</translation>
    </message>
    <message>
        <source>Ending …</source>
        <translation>Endet …</translation>
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
        <translation>{stem} nochmal</translation>
    </message>
    <message>
        <source>Reading the commands of {name} …</source>
        <translation>Die Sollwerte von {name} werden gelesen …</translation>
    </message>
    <message>
        <source>Replay</source>
        <translation>Ansehen</translation>
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
        <source>Compare the record with the model in use</source>
        <translation>Die Aufzeichnung mit dem verwendeten Modell vergleichen</translation>
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
        <source>{names} and {n} more</source>
        <translation>{names} und {n} weitere</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Löschen</translation>
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
        <source> and {n} more</source>
        <translation> und {n} weitere</translation>
    </message>
    <message>
        <source>from {begin:g} s: the recording lasts {duration:.3f} s</source>
        <translation>ab {begin:g} s: die Aufnahme dauert {duration:.3f} s</translation>
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
        <source>it is already a record; only recordings can be exported</source>
        <translation>es ist schon eine Aufzeichnung; nur Aufnahmen lassen sich exportieren</translation>
    </message>
    <message>
        <source>Export the section as an ASCII record for comparison and diagnosis</source>
        <translation>Den Abschnitt als ASCII-Aufzeichnung exportieren, zum Vergleichen und Diagnostizieren</translation>
    </message>
    <message>
        <source>Use the commands of the section as a trajectory; every axis must be at rest at both ends</source>
        <translation>Die Sollwerte des Abschnitts als Trajektorie verwenden; jede Achse muss an beiden Enden in Ruhe sein</translation>
    </message>
    <message>
        <source>Display the recording instead of the machine</source>
        <translation>Die Aufnahme anstelle der Maschine zeigen</translation>
    </message>
    <message>
        <source>this recording is not displayed</source>
        <translation>diese Aufnahme wird nicht gezeigt</translation>
    </message>
    <message>
        <source>Start the section at the present time of the replay</source>
        <translation>Den Abschnitt am aktuellen Zeitpunkt der Wiedergabe beginnen</translation>
    </message>
    <message>
        <source>End the section at the present time of the replay</source>
        <translation>Den Abschnitt am aktuellen Zeitpunkt der Wiedergabe beenden</translation>
    </message>
    <message>
        <source>its file has not moved</source>
        <translation>die Datei wurde nicht verschoben</translation>
    </message>
    <message>
        <source>Delete {names}? This permanently deletes {size} from the disk. Files in other folders stay; only their entries are removed.</source>
        <translation>{names} löschen? Das löscht {size} endgültig vom Datenträger. Dateien in anderen Ordnern bleiben; nur ihre Einträge werden entfernt.</translation>
    </message>
    <message>
        <source>{end} of the section in seconds</source>
        <translation>{end} des Abschnitts in Sekunden</translation>
    </message>
    <message>
        <source>Seconds from the start of the recording; empty: its {end}</source>
        <translation>Sekunden ab Beginn der Aufnahme; leer: ihr {end}</translation>
    </message>
    <message>
        <source>start</source>
        <translation>Beginn</translation>
    </message>
    <message>
        <source>Another program is recording {name}.</source>
        <translation>Ein anderes Programm nimmt {name} auf.</translation>
    </message>
    <message>
        <source>Interrupted because the program or the computer stopped: {names}.</source>
        <translation>Unterbrochen, weil Programm oder Rechner ausfielen: {names}.</translation>
    </message>
    <message>
        <source>from {begin:g} s to {end:g} s: the end must be later than the start</source>
        <translation>von {begin:g} s bis {end:g} s: das Ende muss nach dem Beginn liegen</translation>
    </message>
    <message>
        <source>Starting …</source>
        <translation>Beginnt …</translation>
    </message>
    <message>
        <source>Only {free} are free, but ending the recording needs {size}. Free disk space; the motion continues in any case.</source>
        <translation>Nur {free} sind frei, aber das Beenden der Aufnahme braucht {size}. Speicherplatz schaffen; die Bewegung läuft in jedem Fall weiter.</translation>
    </message>
    <message>
        <source>Enter writes the remark into the recording with the present time</source>
        <translation>Enter schreibt die Bemerkung mit der aktuellen Zeit in die Aufnahme</translation>
    </message>
    <message>
        <source>Start a recording whenever the program starts</source>
        <translation>Bei jedem Programmstart eine Aufnahme beginnen</translation>
    </message>
    <message>
        <source>Folder of the recordings; select the text to copy it</source>
        <translation>Ordner der Aufnahmen; den Text zum Kopieren markieren</translation>
    </message>
    <message>
        <source>The recording is just being started or ended; wait, then press again.</source>
        <translation>Die Aufnahme wird gerade begonnen oder beendet; warten, dann noch einmal drücken.</translation>
    </message>
    <message>
        <source>type a remark first</source>
        <translation>erst eine Bemerkung eingeben</translation>
    </message>
    <message>
        <source>Nothing was noted: {why}.</source>
        <translation>Nichts wurde vermerkt: {why}.</translation>
    </message>
    <message>
        <source>End the recording and save it in one file</source>
        <translation>Die Aufnahme beenden und in einer Datei speichern</translation>
    </message>
    <message>
        <source>Record all signals and events from now on</source>
        <translation>Ab jetzt alle Signale und Ereignisse aufnehmen</translation>
    </message>
    <message>
        <source>wait until the running task has finished</source>
        <translation>warten Sie, bis die laufende Aufgabe fertig ist</translation>
    </message>
    <message>
        <source>Write the remark into the recording with the present time</source>
        <translation>Die Bemerkung mit der aktuellen Zeit in die Aufnahme schreiben</translation>
    </message>
    <message>
        <source>Starting the recording …</source>
        <translation>Die Aufnahme beginnt …</translation>
    </message>
    <message>
        <source>Ending the recording: {size} are being merged …</source>
        <translation>Die Aufnahme endet: {size} werden zusammengefügt …</translation>
    </message>
    <message>
        <source>Saved the recording {path}</source>
        <translation>Aufnahme gespeichert: {path}</translation>
    </message>
    <message>
        <source>The recording has failed: {failure}. Free disk space; the motion continues.</source>
        <translation>Die Aufnahme ist fehlgeschlagen: {failure}. Speicherplatz schaffen; die Bewegung läuft weiter.</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>Interrupted recordings: {names}. Recover them in the panel {title}.</source>
        <translation>Unterbrochene Aufnahmen: {names}. Im Panel {title} lassen sie sich wiederherstellen.</translation>
    </message>
    <message>
        <source>Stored with every playback and recording from now on</source>
        <translation>Wird ab jetzt mit jeder Wiedergabe und Aufnahme gespeichert</translation>
    </message>
    <message>
        <source>Event</source>
        <translation>Ereignis</translation>
    </message>
    <message>
        <source>Events of the displayed recording</source>
        <translation>Ereignisse der gezeigten Aufnahme</translation>
    </message>
    <message>
        <source>with states and log</source>
        <translation>mit Zuständen und Protokoll</translation>
    </message>
    <message>
        <source>Also show states and log lines, not only actions and messages</source>
        <translation>Auch Zustände und Protokoll zeigen, nicht nur Handlungen und Meldungen</translation>
    </message>
    <message>
        <source>{name}: {n} of {all} events; click one to jump there</source>
        <translation>{name}: {n} von {all} Ereignissen; ein Klick springt dorthin</translation>
    </message>
    <message>
        <source>Complete interrupted recordings with the data on the disk</source>
        <translation>Unterbrochene Aufnahmen mit den Daten auf dem Datenträger vervollständigen</translation>
    </message>
    <message>
        <source>{what}: {text!r} is not valid. Enter seconds from the start of the recording, 0 or more, with a decimal point, or leave the field empty.</source>
        <translation>{what}: {text!r} ist ungültig. Sekunden ab Beginn der Aufnahme eingeben, 0 oder mehr, mit Dezimalkomma, oder das Feld leer lassen.</translation>
    </message>
</context>
</TS>
