; The tick, and step edges. The tick lets others in as soon as it has set its next time. A stream
; that changes its command at every tick has another tick than one that holds rows, in whole steps.
;
; A stepper's drive is taken to make its microsteps by itself: it gets an edge every 50 steps of
; 0.1 um, which is a full step, so 2000 a second at 10 mm/s.
        .include "board.inc"
        .text

; What every tick does: its next time, the board's clock, the watchdog, the segment's ticks.
        .macro TICK
        ldaa #0x08
        staa TFLG1
        ldd TOC5
        addd #2000                  ; E cycles at 2 MHz and 1 kHz, or at 4 MHz and 2 kHz
        std TOC5
        cli
        ldd *time+2
        addd #1000
        std *time+2
        ldd *time
        adcb #0
        adca #0
        std *time
        ldx *silence
        dex
        beq cold
        stx *silence
        ldx *left
        beq cold
        dex
        stx *left
        beq cold                    ; the next segment: load_axes or load_rows
        .endm

; The tick of a stream that holds its rows: between two of them nothing changes.
        .globl isr_held
isr_held:
        TICK
        ldx *until
        dex
        stx *until
        beq row_axes
held:   rti

; Two additions of 16 bits an axis, in whole steps, and whether the axis can make them.
        .macro ROW axis
        ldd *axes+SIZE*\axis+FIRST
        addd *axes+SIZE*\axis+SECOND
        std *axes+SIZE*\axis+FIRST
        addd *axes+SIZE*\axis+MOST
        cpd *axes+SIZE*\axis+SPAN
        bhi cold                    ; farther than the axis goes in a row: refused, and halted
        ldd *axes+SIZE*\axis+FIRST
        addd *axes+SIZE*\axis+POS
        std *axes+SIZE*\axis+POS
        std *axes+SIZE*\axis+TOLD
        .endm

row_axes:
        ldx *hold
        stx *until
        ROW 0
        ROW 1
        ROW 2

; Of a stepper: a motor follows no leap, so its edges are spread over the time of the row.
        .macro SPREAD axis
        ldd *axes+SIZE*\axis+FIRST
        eora *axes+SIZE*\axis+TURN
        bmi cold                    ; it turns about
        ldaa *axes+SIZE*\axis+FIRST
        bpl 1f
        coma
        comb
        addd #1
1:      addb *axes+SIZE*\axis+REST
        adca #0
        ldx #50
        idiv                        ; edges, and what is left of the steps
        stab *axes+SIZE*\axis+REST
        stx *product                ; less than 256
        ldab *product+1
        stab *axes+SIZE*\axis+EDGES
        ldd *lasts
        ldx *product
        idiv
        stx *axes+SIZE*\axis+PACE
        xgdx
        addd TCNT
        std TOC2+2*\axis
        .endm

micro_row:
        SPREAD 0
        SPREAD 1
        SPREAD 2
        rti

; The tick of a stream that changes its command at every tick.
        .globl isr_tick
isr_tick:
        TICK

; Two additions of 32 bits an axis, the steps of this tick, and whether the axis can make them.
        .macro STEP axis
        ldd *axes+SIZE*\axis+FIRST+2
        addd *axes+SIZE*\axis+SECOND+2
        std *axes+SIZE*\axis+FIRST+2
        ldd *axes+SIZE*\axis+FIRST
        adcb *axes+SIZE*\axis+SECOND+1
        adca *axes+SIZE*\axis+SECOND
        std *axes+SIZE*\axis+FIRST
        ldd *axes+SIZE*\axis+POS+2
        addd *axes+SIZE*\axis+FIRST+2
        std *axes+SIZE*\axis+POS+2
        ldd *axes+SIZE*\axis+POS
        adcb *axes+SIZE*\axis+FIRST+1
        adca *axes+SIZE*\axis+FIRST
        std *axes+SIZE*\axis+POS
        subd *axes+SIZE*\axis+TOLD
        stab *axes+SIZE*\axis+MADE
        addd *axes+SIZE*\axis+MOST
        cpd *axes+SIZE*\axis+SPAN
        bhi cold                    ; more steps than speed x tick: refused, and halted
        ldd *axes+SIZE*\axis+POS
        std *axes+SIZE*\axis+TOLD
        .endm

step_axes:
        STEP 0
        STEP 1
        STEP 2

; Of a stepper: how many edges this tick has, and how far apart they are.
        .macro PACE axis
        ldab *axes+SIZE*\axis+MADE
        tba
        eora *axes+SIZE*\axis+TURN
        bmi cold                    ; it turns about
        tstb
        bpl 1f
        negb
1:      addb *axes+SIZE*\axis+REST
        ldx #shares
        abx
        ldaa 0,x                    ; edges of so many steps
        ldab 160,x                  ; and what is left of them
        stab *axes+SIZE*\axis+REST
        staa *axes+SIZE*\axis+EDGES
        tab
        aslb
        ldx #paces
        abx
        ldd 0,x
        std *axes+SIZE*\axis+PACE
        addd TCNT
        std TOC2+2*\axis
        .endm

micro_out:
        PACE 0
        PACE 1
        PACE 2
        rti

cold:   rts

; Of a piezo: steps * gain + base is the code of its converter; gain in codes a step * 2^-15.
        .macro CODE axis
        ldaa *axes+SIZE*\axis+POS+1
        ldab *axes+SIZE*\axis+GAIN+1
        mul
        std *product+2
        ldaa *axes+SIZE*\axis+POS
        ldab *axes+SIZE*\axis+GAIN
        mul
        std *product
        ldaa *axes+SIZE*\axis+POS
        ldab *axes+SIZE*\axis+GAIN+1
        mul
        addd *product+1
        std *product+1
        bcc 1f
        inc product
1:      ldaa *axes+SIZE*\axis+POS+1
        ldab *axes+SIZE*\axis+GAIN
        mul
        addd *product+1
        std *product+1
        bcc 2f
        inc product
2:      ldd *product
        asl product+2
        rolb
        rola
        addd *axes+SIZE*\axis+BASE
        std OUTPUTS+2*\axis
        .endm

nano_out:
        CODE 0
        CODE 1
        CODE 2
        rti

; A step edge of the first axis; the others have the same.
        .globl isr_edge
isr_edge:
        ldaa #0x40
        staa TFLG1
        ldd TOC2
        addd *axes+PACE
        std TOC2
        ldaa PORTB
        eora #0x01
        staa PORTB
        dec axes+EDGES
        beq cold
        rti

; The next segment, out of the queue (X).
        .macro LOAD axis
        ldd 2+8*\axis,x
        std *axes+SIZE*\axis+FIRST
        ldd 4+8*\axis,x
        std *axes+SIZE*\axis+FIRST+2
        ldd 6+8*\axis,x
        std *axes+SIZE*\axis+SECOND
        ldd 8+8*\axis,x
        std *axes+SIZE*\axis+SECOND+2
        .endm

        .macro LOADED
        ldab #26
        abx
        cpx #QUEUE_END
        bne 1f
        ldx #queue
1:      stx *oldest
        rts
        .endm

        .globl load_axes
load_axes:
        ldx *oldest
        ldd 0,x
        std *left
        LOAD 0
        LOAD 1
        LOAD 2
        LOADED

; The same of held rows: the low words are whole steps.
        .macro WHOLE axis
        ldd 4+8*\axis,x
        std *axes+SIZE*\axis+FIRST
        ldd 8+8*\axis,x
        std *axes+SIZE*\axis+SECOND
        .endm

        .globl load_rows
load_rows:
        ldx *oldest
        ldd 0,x
        std *left
        WHOLE 0
        WHOLE 1
        WHOLE 2
        LOADED

shares: .space 320                  ; edges of 0 to 150 steps, and 160 further on what is left
paces:  .word 0, 1900, 950, 633
