; Serial input and output. A received byte is put into a ring buffer while interrupts are masked. It
; is decoded while they are enabled, so a tick or a step edge never waits for a CRC.
        .include "board.inc"
        .text

; Serial interrupt: a byte was received, or the transmitter is ready for the next one.
        .globl isr_serial
isr_serial:
        ldaa SCSR
        bita #0x20
        beq isr_send
isr_receive:                        ; a received byte goes into the ring buffer
        bita #0x0E                  ; the byte has an overrun, noise or framing error
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
isr_send:                           ; send the next byte of the outgoing frame
        ldx *out
        ldab 0,x
        stab SCDR
        inx
        stx *out
        dec count
        beq cold
        rti

; Background: decode a byte from the ring buffer.
        .globl take_byte
take_byte:
        ldab *tail
        cmpb *head
        beq cold                    ; the buffer is empty
        ldx #ring
        abx
        ldaa 0,x
        incb
        andb #RING
        stab *tail
        tsta
        beq cold                    ; a zero ends a frame, or means stop
        dec code
        beq take_stretch
take_plain:                         ; a byte of a block goes into the frame and its CRC
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
take_stretch:                       ; the length of the next block stands for a zero
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

; Background: append a byte (A) to the outgoing frame, with CRC and COBS.
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
put_stretch:                        ; a zero is replaced by the length of its block
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

; Background: put the segment of a complete frame into the queue. It has three axes.
; Frame: address, number, type, index, ticks (2), then for each axis first (4) and second (3).
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

table:  .space 512                  ; of the CRC, two bytes per entry
