; Control tick and step edges. The tick enables other interrupts as soon as it has set its next time.
; There are two versions: for streams that change the command at every tick, and for streams that
; hold rows, in whole steps.
;
; The drive of a stepper is assumed to make its microsteps by itself. It gets an edge every 50 steps
; of 0.1 um, which is a full step: 2000 edges per second at 10 mm/s.
        .include "board.inc"
        .text

; Common part of all ticks: next tick, clock of the board, watchdog, ticks of the segment.
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
        beq cold                    ; load the next segment: load_axes or load_rows
        .endm

; Tick of a stream that holds its rows. Between two rows nothing changes.
        .globl isr_held
isr_held:
        TICK
        ldx *until
        dex
        stx *until
        beq row_axes
held:   rti

; Two 16-bit additions per axis, in whole steps, and a check of the speed.
        .macro ROW axis
        ldd *axes+SIZE*\axis+FIRST
        addd *axes+SIZE*\axis+SECOND
        std *axes+SIZE*\axis+FIRST
        addd *axes+SIZE*\axis+MOST
        cpd *axes+SIZE*\axis+SPAN
        bhi cold                    ; too fast: refuse it and halt
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

; A motor cannot follow a jump. So the step edges are spread over the time of the row.
        .macro SPREAD axis
        ldd *axes+SIZE*\axis+FIRST
        eora *axes+SIZE*\axis+TURN
        bmi cold                    ; the direction changes
        ldaa *axes+SIZE*\axis+FIRST
        bpl 1f
        coma
        comb
        addd #1
1:      addb *axes+SIZE*\axis+REST
        adca #0
        ldx #50
        idiv                        ; quotient: edges, remainder: steps for the next row
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

; Tick of a stream that changes the command at every tick.
        .globl isr_tick
isr_tick:
        TICK

; Two 32-bit additions per axis, the steps of this tick, and a check of the speed.
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
        bhi cold                    ; too fast: refuse it and halt
        ldd *axes+SIZE*\axis+POS
        std *axes+SIZE*\axis+TOLD
        .endm

step_axes:
        STEP 0
        STEP 1
        STEP 2

; Number of step edges in this tick, and the time between them.
        .macro PACE axis
        ldab *axes+SIZE*\axis+MADE
        tba
        eora *axes+SIZE*\axis+TURN
        bmi cold                    ; the direction changes
        tstb
        bpl 1f
        negb
1:      addb *axes+SIZE*\axis+REST
        ldx #shares
        abx
        ldaa 0,x                    ; edges for this number of steps
        ldab 160,x                  ; steps for the next tick
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

; Converter code of a piezo: steps * gain + base. The gain is in codes per step, in 2^-15.
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

; Step edge of the first axis. The other axes have the same code.
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

; Load the next segment from the queue (X).
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

; The same for held rows. Only the low words are used, which are whole steps.
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

shares: .space 320                  ; edges for 0 to 150 steps, and 160 bytes later the remaining steps
paces:  .word 0, 1900, 950, 633
