; Bytes that come and go. A byte that comes is put into a ring with interrupts masked, and taken
; apart without: so a tick or a step edge never waits for a check sum.
        .include "board.inc"
        .text

; The serial interrupt: a byte has come, or the line takes one.
        .globl isr_serial
isr_serial:
        ldaa SCSR
        bita #0x20
        beq isr_send
isr_receive:                        ; into the ring
        bita #0x0E                  ; overrun, noise, framing: not this byte
        bne cold
        ldaa SCDR
        ldab *head
        ldx #ring
        abx
        staa 0,x
        incb
        andb #RING
        stab *head
        rti
isr_send:                           ; the next one of the frame that goes
        ldx *out
        ldab 0,x
        stab SCDR
        inx
        stx *out
        dec count
        beq cold
        rti

; Background: take a byte out of the ring.
        .globl take_byte
take_byte:
        ldab *tail
        cmpb *head
        beq cold                    ; there is none
        ldx #ring
        abx
        ldaa 0,x
        incb
        andb #RING
        stab *tail
        tsta
        beq cold                    ; a zero ends a frame, or is a stop
        dec code
        beq take_stretch
take_plain:                         ; one of a stretch goes into the frame and its check
        ldx *in
        staa 0,x
        inx
        cpx #FRAME_END
        bhs cold
        stx *in
        tab
        eorb *crc
        ldx #table
        abx
        abx
        ldd 0,x
        eora *crc+1
        std *crc
        rts
take_stretch:                       ; one that tells the length of the next stretch means a zero
        staa *code
        ldx *in
        clr 0,x
        inx
        cpx #FRAME_END
        bhs cold
        stx *in
        ldab *crc
        ldx #table
        abx
        abx
        ldd 0,x
        eora *crc+1
        std *crc
        rts

cold:   rts

; Background: put a byte (A) behind the frame that goes, into its check and its stuffing.
        .globl put_byte
put_byte:
        staa *byte
        tab
        eorb *crc
        ldx #table
        abx
        abx
        ldd 0,x
        eora *crc+1
        std *crc
        ldaa *byte
        beq put_stretch
put_plain:
        ldx *in
        staa 0,x
        inx
        stx *in
        inc code
        rts
put_stretch:                        ; a zero is left out; the length of its stretch is written
        ldx *mark
        ldaa *code
        staa 0,x
        ldx *in
        stx *mark
        inx
        stx *in
        ldaa #1
        staa *code
        rts

; Background: a whole frame for this board is a segment of three axes; it goes into the queue.
; frame: address, number, type, index, ticks (2), three times first (4) and second (3).
        .macro SEGMENT
        ldd 6,x
        std 2,y
        ldd 8,x
        std 4,y
        clra
        ldab 10,x
        bpl 1f
        coma
1:      std 6,y
        ldd 11,x
        std 8,y
        ldab #7
        abx
        ldab #8
        aby
        .endm

        .globl take_segment
take_segment:
        ldx #frame
        ldaa 2,x
        cmpa #0x12
        bne cold
        ldaa 3,x
        cmpa *next
        bne cold                    ; out of order
        ldy #queue
        ldd 4,x
        std 0,y
        SEGMENT
        SEGMENT
        SEGMENT
        inc next
        rts

table:  .space 512                  ; of the check sum, two bytes an entry
