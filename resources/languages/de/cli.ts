<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>cli</name>
    <message>
        <source>--seed {seed}: must be 0 or more</source>
        <translation>--seed {seed}: muss 0 oder größer sein</translation>
    </message>
    <message>
        <source>--mishaps {mishaps}: must be from 0 to 1000 a second</source>
        <translation>--mishaps {mishaps}: muss zwischen 0 und 1000 je Sekunde liegen</translation>
    </message>
    <message>
        <source>{asked} ports: two boards have at most {most_ports}</source>
        <translation>{asked} Anschlüsse: zwei Karten haben höchstens {most_ports}</translation>
    </message>
    <message>
        <source>--bus uses one line; name only one port</source>
        <translation>--bus nutzt eine einzige Leitung; nur einen Anschluss angeben</translation>
    </message>
    <message>
        <source>--bus: the robot&apos;s axes need only one board, so no line is shared</source>
        <translation>--bus: die Achsen des Roboters brauchen nur eine Karte, daher wird keine Leitung geteilt</translation>
    </message>
    <message>
        <source>this system has no pseudo-terminals ({error}); use --tcp 127.0.0.1:0</source>
        <translation>dieses System hat keine Pseudoterminals ({error}); --tcp 127.0.0.1:0 verwenden</translation>
    </message>
    <message>
        <source>--tcp {address}: cannot listen there: {error}</source>
        <translation>--tcp {address}: dort lässt sich nicht lauschen: {error}</translation>
    </message>
    <message>
        <source>--tcp {address}: {value} is not a loopback address; anyone who reaches a board can move it: use 127.0.0.1:PORT</source>
        <translation>--tcp {address}: {value} ist keine Loopback-Adresse; wer eine Karte erreicht, kann sie bewegen: 127.0.0.1:PORT verwenden</translation>
    </message>
    <message>
        <source>--tcp {address}: the port must be a number from 0 (any) to 65535</source>
        <translation>--tcp {address}: der Port muss eine Zahl von 0 (beliebig) bis 65535 sein</translation>
    </message>
    <message>
        <source>--port {link} already exists; remove it, or choose another name</source>
        <translation>--port {link} gibt es schon; entfernen oder einen anderen Namen wählen</translation>
    </message>
    <message>
        <source>--port {link}: cannot create a link there: {error}</source>
        <translation>--port {link}: dort lässt sich keine Verknüpfung anlegen: {error}</translation>
    </message>
    <message>
        <source>--laser: {count} files for {records} records; give one for each</source>
        <translation>--laser: {count} Dateien für {records} Aufzeichnungen; für jede eine angeben</translation>
    </message>
    <message>
        <source>--fit re-fits the model, which --with does not use; use only one of them</source>
        <translation>--fit passt das Modell neu an, das --with nicht verwendet; nur eines von beiden angeben</translation>
    </message>
    <message>
        <source>--simulate takes no records; leave out one or the other</source>
        <translation>--simulate nimmt keine Aufzeichnungen; eines von beiden weglassen</translation>
    </message>
    <message>
        <source>no record is named; name one, or use --simulate</source>
        <translation>keine Aufzeichnung genannt; eine angeben oder --simulate verwenden</translation>
    </message>
    <message>
        <source>--effects and --seed belong to --simulate; leave them out, or add it</source>
        <translation>--effects und --seed gehören zu --simulate; weglassen oder es hinzufügen</translation>
    </message>
    <message>
        <source>--simulate needs --axis NAME</source>
        <translation>--simulate braucht --axis NAME</translation>
    </message>
    <message>
        <source>{path}: its piezo axes are {found}; name one by --axis</source>
        <translation>{path}: die Piezoachsen darin sind {found}; eine mit --axis angeben</translation>
    </message>
    <message>
        <source>{output} is the input file; choose another output with -o</source>
        <translation>{output} ist die Eingabedatei; mit -o eine andere Ausgabe wählen</translation>
    </message>
    <message>
        <source>--units {chosen}: a position&apos;s unit is a length or an angle</source>
        <translation>--units {chosen}: die Einheit einer Position ist eine Länge oder ein Winkel</translation>
    </message>
    <message>
        <source>there is no effect {effect_id}; available: {names}</source>
        <translation>den Effekt {effect_id} gibt es nicht; vorhanden: {names}</translation>
    </message>
    <message>
        <source>{text} is not one of {names}</source>
        <translation>{text} ist keines von {names}</translation>
    </message>
    <message>
        <source>{text} is not {advice}</source>
        <translation>{text} ist nicht {advice}</translation>
    </message>
    <message>
        <source>--{option}: {error}</source>
        <translation>--{option}: {error}</translation>
    </message>
    <message>
        <source>--{option}: {text}; write it as {metavar}</source>
        <translation>--{option}: {text}; so schreiben: {metavar}</translation>
    </message>
    <message>
        <source>unknown kind {kind}; use one of {names}</source>
        <translation>unbekannte Art {kind}; möglich: {names}</translation>
    </message>
    <message>
        <source>axis {name}: robot {robot_name} has no such axis; use one of {names}</source>
        <translation>Achse {name}: Roboter {robot_name} hat keine solche Achse; möglich: {names}</translation>
    </message>
    <message>
        <source>{kind} has no --{refused}; it takes {names}</source>
        <translation>{kind} kennt kein --{refused}; möglich: {names}</translation>
    </message>
    <message>
        <source>--{option}: axis {key} is not one of those that move</source>
        <translation>--{option}: Achse {key} gehört nicht zu den bewegten</translation>
    </message>
    <message>
        <source>--{option}: {text} has two values for an axis</source>
        <translation>--{option}: {text} enthält zwei Werte für eine Achse</translation>
    </message>
    <message>
        <source>diagnose the records of that machine</source>
        <translation>die Aufzeichnungen jener Maschine diagnostizieren</translation>
    </message>
    <message>
        <source>{output} is named twice; give each file its own name</source>
        <translation>{output}: der Name kommt zweimal vor; jeder Datei einen eigenen geben</translation>
    </message>
    <message>
        <source>{output} already exists; choose another file with -o</source>
        <translation>{output}: die Datei gibt es schon; mit -o eine andere wählen</translation>
    </message>
    <message>
        <source>{output} cannot be written: there is no folder {parent}; create it, or choose another</source>
        <translation>{output}: kann nicht geschrieben werden, den Ordner {parent} gibt es nicht; anlegen oder einen anderen wählen</translation>
    </message>
    <message>
        <source>{other} would be overwritten by a suggested experiment of {document}; name another file by --json</source>
        <translation>{other} würde von einem vorgeschlagenen Experiment von {document} überschrieben; mit --json eine andere Datei angeben</translation>
    </message>
    <message>
        <source>--zn, --thx, --thy: must be finite numbers</source>
        <translation>--zn, --thx, --thy: müssen endliche Zahlen sein</translation>
    </message>
    <message>
        <source>the pin&apos;s bottom cannot move that far: --zn, --thx, --thy must be within ± {farthest} µm or µrad</source>
        <translation>so weit kommt das untere Ende des Stifts nicht: --zn, --thx, --thy müssen innerhalb von ± {farthest} µm oder µrad liegen</translation>
    </message>
    <message>
        <source>{trajectory}: {objections}{more}</source>
        <translation>{trajectory}: {objections}{more}</translation>
    </message>
    <message>
        <source>{trajectory}: {duration}, {rows} rows, {verdict}</source>
        <translation>{trajectory}: {duration}, {rows} Zeilen, {verdict}</translation>
    </message>
    <message>
        <source>there is no {wanted} {name}; `rotemina plugin list` lists all</source>
        <translation>{wanted} {name} gibt es nicht; `rotemina plugin list` zeigt, was es gibt</translation>
    </message>
    <message>
        <source>--from {begin} --to {end}: must be 0 or more, and in order</source>
        <translation>--from {begin} --to {end}: müssen 0 oder größer und in dieser Reihenfolge sein</translation>
    </message>
    <message>
        <source>--trajectory and --reference: choose one of them</source>
        <translation>--trajectory und --reference: nur eines von beiden wählen</translation>
    </message>
    <message>
        <source>--period {period}: must be more than 0 s</source>
        <translation>--period {period}: muss größer als 0 s sein</translation>
    </message>
    <message>
        <source>choose its model with --robot</source>
        <extracomment>Advice if a record does not fit the model of the machine.</extracomment>
        <translation>ihr Modell mit --robot wählen</translation>
    </message>
    <message>
        <source>Model: {robot} (built in); choose another with --robot</source>
        <translation>Modell: {robot} (eingebaut); ein anderes mit --robot wählen</translation>
    </message>
    <message>
        <source>Model: {robot} ({file})</source>
        <translation>Modell: {robot} ({file})</translation>
    </message>
    <message>
        <source>--max-speed {part}: axis {axis} does not move; use one of {axes}</source>
        <translation>--max-speed {part}: Achse {axis} bewegt sich nicht; möglich: {axes}</translation>
    </message>
    <message>
        <source>--max-speed {part}: is in {unit}, not in {expected}</source>
        <translation>--max-speed {part}: ist in {unit} angegeben, nicht in {expected}</translation>
    </message>
    <message>
        <source>--max-speed {text}: has two values for {what}</source>
        <translation>--max-speed {text}: enthält zwei Werte für {what}</translation>
    </message>
    <message>
        <source>--max-speed {part}: {error}</source>
        <translation>--max-speed {part}: {error}</translation>
    </message>
    <message>
        <source>--max-speed {part}: must be a speed above 0, such as 10mm/s</source>
        <translation>--max-speed {part}: muss eine Geschwindigkeit über 0 sein, etwa 10mm/s</translation>
    </message>
    <message>
        <source>gap: name a subcommand: check, diagnose, predict, twin, blind or bench (see --help)</source>
        <translation>gap: einen Unterbefehl angeben: check, diagnose, predict, twin, blind oder bench (siehe --help)</translation>
    </message>
    <message>
        <source>the robot file states no speed limit (max_speed) of {axes}; give the greatest speed that the machine may move at, such as --max-speed {example}</source>
        <translation>die Roboterdatei nennt keine Geschwindigkeitsgrenze (max_speed) für {axes}; die größte Geschwindigkeit angeben, mit der die Maschine fahren darf, etwa --max-speed {example}</translation>
    </message>
    <message>
        <source>{output} is a folder; name a file in it</source>
        <translation>{output} ist ein Ordner; geben Sie eine Datei darin an</translation>
    </message>
    <message>
        <source>{output} cannot be written: no permission to create files in {parent}; choose another folder</source>
        <translation>{output} kann nicht geschrieben werden: keine Berechtigung, Dateien in {parent} anzulegen; wählen Sie einen anderen Ordner</translation>
    </message>
    <message>
        <source>{effects}: on robot {name}: {error}</source>
        <translation>{effects}: bei Roboter {name}: {error}</translation>
    </message>
    <message>
        <source>--jobs {jobs}: must be 1 or more</source>
        <translation>--jobs {jobs}: muss 1 oder größer sein</translation>
    </message>
    <message>
        <source>--cluster {cluster}: Dask is not installed; install it by pip install &apos;rotemina[dask]&apos;, here and on the cluster&apos;s machines</source>
        <translation>--cluster {cluster}: Dask ist nicht installiert; hier und auf den Rechnern des Clusters mit pip install &apos;rotemina[dask]&apos; installieren</translation>
    </message>
    <message>
        <source>--cluster {cluster} cannot be reached ({error}); name the address of a running Dask scheduler</source>
        <translation>--cluster {cluster}: nicht erreichbar ({error}); die Adresse eines laufenden Dask-Schedulers angeben</translation>
    </message>
    <message>
        <source>--cluster {cluster} has no workers; start some by dask worker {cluster}</source>
        <translation>--cluster {cluster}: keine Worker; starten mit dask worker {cluster}</translation>
    </message>
    <message>
        <source>--cluster: a worker died repeatedly at the same task ({error}); check its memory and its log</source>
        <translation>--cluster: ein Worker brach wiederholt bei derselben Aufgabe ab ({error}); seinen Speicher und sein Protokoll prüfen</translation>
    </message>
    <message>
        <source>--cluster: work could not be sent: {said}</source>
        <translation>--cluster: Arbeit ließ sich nicht verteilen: {said}</translation>
    </message>
    <message>
        <source>{file}: {reason}; check its name and folder</source>
        <translation>{file}: {reason}; Name und Ordner prüfen</translation>
    </message>
    <message>
        <source>interrupted</source>
        <translation>abgebrochen</translation>
    </message>
    <message>
        <source>originates in another axis, named by from_axis</source>
        <translation>geht von einer anderen Achse aus, die from_axis nennt</translation>
    </message>
    <message>
        <source>formulation {name}</source>
        <translation>Formulierung {name}</translation>
    </message>
    <message>
        <source>source: {source}</source>
        <translation>Quelle: {source}</translation>
    </message>
    <message>
        <source>{preset} ({low} to {high})</source>
        <translation>{preset} ({low} bis {high})</translation>
    </message>
    <message>
        <source>acts on axes of kind {kinds}</source>
        <translation>wirkt auf Achsen der Art {kinds}</translation>
    </message>
    <message>
        <source>traits: {traits}</source>
        <translation>Merkmale: {traits}</translation>
    </message>
    <message>
        <source>left out: {reason}</source>
        <translation>ausgelassen: {reason}</translation>
    </message>
    <message>
        <source>point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>settling [ms]</source>
        <translation>Einschwingen [ms]</translation>
    </message>
    <message>
        <source>overshoot [%]</source>
        <translation>Überschwingen [%]</translation>
    </message>
    <message>
        <source>effort [1/s]</source>
        <translation>Stellaufwand [1/s]</translation>
    </message>
    <message>
        <source>tracking error [%]</source>
        <translation>Folgefehler [%]</translation>
    </message>
    <message>
        <source>integral gain [1/s]</source>
        <translation>I-Anteil [1/s]</translation>
    </message>
    <message>
        <source>tune: give the axis with --axis, or the number of a point with --choose</source>
        <translation>tune: die Achse mit --axis oder die Nummer eines Punktes mit --choose angeben</translation>
    </message>
    <message>
        <source>stopped after {done} of {total} generations; {output} holds the points found so far, and is marked as incomplete</source>
        <translation>nach {done} von {total} Generationen angehalten; {output} enthält die bisher gefundenen Punkte und ist als unvollständig gekennzeichnet</translation>
    </message>
    <message>
        <source>{output} was tuned for robot {robot}, not for {name}; select that robot with --robot</source>
        <translation>{output} ist für Roboter {robot} abgestimmt, nicht für {name}; jenen Roboter mit --robot wählen</translation>
    </message>
    <message>
        <source>{inverse} is an inverse of axis {axis}, but {options_axis} is to be tuned; choose one that was trained on this axis</source>
        <translation>{inverse}: eine Inverse von Achse {axis}, abgestimmt werden soll {options_axis}; eine wählen, die mit dieser Achse trainiert wurde</translation>
    </message>
    <message>
        <source>{output}: axis {axis}, loop at {rate}</source>
        <translation>{output}: Achse {axis}, Regelkreis mit {rate}</translation>
    </message>
    <message>
        <source>chosen</source>
        <translation>gewählt</translation>
    </message>
    <message>
        <source>recommended</source>
        <translation>empfohlen</translation>
    </message>
    <message>
        <source>{done} of {total} generations, {points} points</source>
        <translation>{done} von {total} Generationen, {points} Punkte</translation>
    </message>
    <message>
        <source>{place}: {kind} {name}; install it with
  pip install --editable &apos;{place}[test]&apos;
and check it with `rotemina plugin check {name}` and `pytest {place}`.</source>
        <translation>{place}: {kind} {name}; installieren mit
  pip install --editable &apos;{place}[test]&apos;
und prüfen mit `rotemina plugin check {name}` und `pytest {place}`.</translation>
    </message>
    <message>
        <source>{version} of {current}</source>
        <translation>{version} von {current}</translation>
    </message>
    <message>
        <source>loaded</source>
        <translation>geladen</translation>
    </message>
    <message>
        <source>kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>package</source>
        <translation>Paket</translation>
    </message>
    <message>
        <source>version</source>
        <translation>Version</translation>
    </message>
    <message>
        <source>interface</source>
        <translation>Schnittstelle</translation>
    </message>
    <message>
        <source>state</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>{output}: {count} inverses</source>
        <translation>{output}: {count} Inverse</translation>
    </message>
    <message>
        <source>recommended: {why}</source>
        <translation>empfohlen: {why}</translation>
    </message>
    <message>
        <source>any clock</source>
        <translation>beliebige Uhr</translation>
    </message>
    <message>
        <source>real time</source>
        <translation>Echtzeit</translation>
    </message>
    <message>
        <source>moves</source>
        <translation>bewegt</translation>
    </message>
    <message>
        <source>left out: {name}: {reason}</source>
        <translation>ausgelassen: {name}: {reason}</translation>
    </message>
    <message>
        <source>{name} may drive a real machine: ALL AXES WILL MOVE, including to the ends of their ranges. Remove the tool, and keep the machine&apos;s emergency stop switch within reach.</source>
        <translation>{name} kann eine echte Maschine bewegen: ALLE ACHSEN WERDEN SICH BEWEGEN, auch bis an die Enden ihrer Bereiche. Das Werkzeug abnehmen; der Not-Halt der Maschine muss in Reichweite sein.</translation>
    </message>
    <message>
        <source>{name} may drive a real machine: only checks without motion run; --move lets the axes move</source>
        <translation>{name} kann eine echte Maschine bewegen: nur Prüfungen ohne Bewegung laufen; --move lässt die Achsen fahren</translation>
    </message>
    <message>
        <source>{name}: axis {axis} of robot {robot}, {runs} runs</source>
        <translation>{name}: Achse {axis} des Roboters {robot}, {runs} Durchläufe</translation>
    </message>
    <message>
        <source>from {name} ({digest})</source>
        <translation>aus {name} ({digest})</translation>
    </message>
    <message>
        <source>{file}: written</source>
        <translation>{file}: geschrieben</translation>
    </message>
    <message>
        <source>{output}: {motion}, {duration}</source>
        <translation>{output}: {motion}, {duration}</translation>
    </message>
    <message>
        <source>no calibrations are stored</source>
        <translation>es sind keine Kalibrierungen gespeichert</translation>
    </message>
    <message>
        <source>on</source>
        <translation>ein</translation>
    </message>
    <message>
        <source>off</source>
        <translation>aus</translation>
    </message>
    <message>
        <source>{causes} first of {tried}: {closed} closed</source>
        <translation>{causes} führt unter {tried}: {closed} geschlossen</translation>
    </message>
    <message>
        <source>about {duration} left</source>
        <translation>noch etwa {duration}</translation>
    </message>
    <message>
        <source>re-tuned model</source>
        <translation>neu abgestimmtes Modell</translation>
    </message>
    <message>
        <source>axis {axis}: command of the inverse minus recorded command</source>
        <translation>Achse {axis}: Sollwert der Inversen minus aufgezeichneter Sollwert</translation>
    </message>
    <message>
        <source>inverse</source>
        <translation>Inverse</translation>
    </message>
    <message>
        <source>rms / range</source>
        <translation>Effektivwert / Bereich</translation>
    </message>
    <message>
        <source>rms [{unit}]</source>
        <translation>Effektivwert [{unit}]</translation>
    </message>
    <message>
        <source>rms without offset [{unit}]</source>
        <translation>Effektivwert ohne Versatz [{unit}]</translation>
    </message>
    <message>
        <source>worst [{unit}]</source>
        <translation>größte Abweichung [{unit}]</translation>
    </message>
    <message>
        <source>{share} of the rows are not evaluated, because they are outside the training range, {low} to {high}</source>
        <translation>{share} der Zeilen werden nicht ausgewertet, weil sie außerhalb des Trainingsbereichs liegen, {low} bis {high}</translation>
    </message>
    <message>
        <source>{axis}.cmd = {value} at row {row} (t = {time}) is outside {low} … {high}; {rows} such rows</source>
        <translation>{axis}.cmd = {value} in Zeile {row} (t = {time}) liegt außerhalb von {low} … {high}; {rows} solche Zeilen</translation>
    </message>
    <message>
        <source>effect {effect} on axis {axis} does not act: the commands name neither this axis nor one coupled to it</source>
        <translation>Effekt {effect} an Achse {axis} wirkt nicht: die Sollwerte nennen weder diese Achse noch eine mit ihr gekoppelte</translation>
    </message>
    <message>
        <source>{inverse} was trained for robot {robot}, not for {name}; select that robot with --robot</source>
        <translation>{inverse}: sie wurde für Roboter {robot} trainiert, nicht für {name}; jenen Roboter mit --robot wählen</translation>
    </message>
    <message>
        <source>recommended after training: {why}</source>
        <translation>nach dem Training empfohlen: {why}</translation>
    </message>
    <message>
        <source>{count} of {names}</source>
        <translation>{count} von {names}</translation>
    </message>
    <message>
        <source>{output}: {rows} rows</source>
        <translation>{output}: {rows} Zeilen</translation>
    </message>
    <message>
        <source>{name}: {rows} rows of {columns}</source>
        <translation>{name}: {rows} Zeilen mit {columns}</translation>
    </message>
    <message>
        <source>{source}: nothing to recover</source>
        <translation>{source}: nichts wiederherzustellen</translation>
    </message>
    <message>
        <source>changed: {what}</source>
        <translation>geändert: {what}</translation>
    </message>
    <message>
        <source>{rows} rows, {duration} at {rate}</source>
        <translation>{rows} Zeilen, {duration} mit {rate}</translation>
    </message>
    <message>
        <source>{summary}, period {rows} rows</source>
        <translation>{summary}, Periode {rows} Zeilen</translation>
    </message>
    <message>
        <source>{output}: robot {robot} with {effects}</source>
        <translation>{output}: Roboter {robot} mit {effects}</translation>
    </message>
    <message>
        <source>{effect} on axis {axis}</source>
        <translation>{effect} an Achse {axis}</translation>
    </message>
    <message>
        <source>--pause needs a previous motion; give its record with --after</source>
        <translation>--pause braucht eine vorausgegangene Bewegung; deren Aufzeichnung mit --after angeben</translation>
    </message>
    <message>
        <source>no further effects</source>
        <translation>keinen weiteren Effekten</translation>
    </message>
    <message>
        <source>playing {share} %</source>
        <translation>abgespielt: {share} %</translation>
    </message>
    <message>
        <source>axis {axis}: commands of {inverse}; other axes unchanged</source>
        <translation>Achse {axis}: Sollwerte der Inversen {inverse}; andere Achsen unverändert</translation>
    </message>
    <message>
        <source>fastest command, before → after resampling:</source>
        <translation>schnellster Sollwert, vor → nach der neuen Abtastung:</translation>
    </message>
    <message>
        <source>{output}: {rows} rows, {duration}</source>
        <translation>{output}: {rows} Zeilen, {duration}</translation>
    </message>
    <message>
        <source>{text} is not an integer</source>
        <translation>{text} ist keine ganze Zahl</translation>
    </message>
    <message>
        <source>ok</source>
        <translation>in Ordnung</translation>
    </message>
    <message>
        <source>limited</source>
        <translation>eingeschränkt</translation>
    </message>
    <message>
        <source>broken</source>
        <translation>defekt</translation>
    </message>
    <message>
        <source>dependencies</source>
        <translation>Abhängigkeiten</translation>
    </message>
    <message>
        <source>Qt libraries</source>
        <translation>Qt-Bibliotheken</translation>
    </message>
    <message>
        <source>Qt platform</source>
        <translation>Qt-Plattform</translation>
    </message>
    <message>
        <source>rendering</source>
        <translation>Darstellung</translation>
    </message>
    <message>
        <source>serial ports</source>
        <translation>serielle Anschlüsse</translation>
    </message>
    <message>
        <source>line rate</source>
        <translation>Leitungsrate</translation>
    </message>
    <message>
        <source>joysticks</source>
        <translation>Joysticks</translation>
    </message>
    <message>
        <source>folders</source>
        <translation>Ordner</translation>
    </message>
    <message>
        <source>disk</source>
        <translation>Datenträger</translation>
    </message>
    <message>
        <source>clock</source>
        <translation>Uhr</translation>
    </message>
    <message>
        <source>simulated {seconds} s</source>
        <translation>{seconds} s simuliert</translation>
    </message>
    <message>
        <source>{axis}: these records can show, at the typical size (in noise floors, rms): {effects}</source>
        <translation>{axis}: Diese Aufzeichnungen können in typischer Größe zeigen (Effektivwert in Rauschgrenzen): {effects}</translation>
    </message>
    <message>
        <source>{axis}: too small here: {effects}; play this: {motion}</source>
        <translation>{axis}: hier zu klein: {effects}; spielen Sie dies: {motion}</translation>
    </message>
    <message>
        <source>{axis}: too small here and in every safe motion: {effects}</source>
        <translation>{axis}: hier und in jeder sicheren Bewegung zu klein: {effects}</translation>
    </message>
    <message>
        <source>{axis}: shown by any motion, if they are there: {effects}</source>
        <translation>{axis}: zeigen sich, falls vorhanden, in jeder Bewegung: {effects}</translation>
    </message>
    <message>
        <source>{effect} ({floors})</source>
        <translation>{effect} ({floors})</translation>
    </message>
</context>
<context>
    <name>gap</name>
    <message>
        <source>the records contain no axis of the robot</source>
        <translation>die Aufzeichnungen enthalten keine Achse des Roboters</translation>
    </message>
</context>
</TS>
