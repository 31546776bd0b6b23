; Frames to the host: telemetry and captured samples.
        .include "board.inc"
        .text

; Header of a telemetry frame: address, number, type, time, state, fault, switches, and the index of
; the next segment.
        .globl tell_head
tell_head:
        ldd #0xFFFF
        std *crc
        ldx #told
        stx *mark
        inx
        stx *in
        ldaa #1
        staa *code
        .irp part, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10
        ldaa *head_of_telemetry+\part
        jsr put_byte
        .endr
        rts

; Telemetry of one axis (X: its encoder): the 24-bit reading, and the deviation of the command.
        .globl tell_axis
tell_axis:
        ldaa 0,x
        pshx
        jsr put_byte
        pulx
        ldaa 1,x
        pshx
        jsr put_byte
        pulx
        ldaa 2,x
        pshx
        jsr put_byte
        pulx
        ldd *axes+TOLD
        subd 1,x                    ; modulo 65 536
        bvs cold                    ; the deviation does not fit and is clipped
        pshb
        jsr put_byte
        pula
        jsr put_byte
        rts

; End of an outgoing frame: its CRC, the length of the last block, and the transmitter interrupt.
        .globl tell_end
tell_end:
        ldd *crc
        coma
        comb
        pshb
        jsr put_byte
        pula
        jsr put_byte
        ldx *mark
        ldaa *code
        staa 0,x
        ldx #told
        stx *out
        ldaa #0xAC
        staa SCCR2
        rts

; Captured sample of one axis: its low 16 bits go into the buffer.
        .globl capture_axis
capture_axis:
        ldd COUNTERS+1
        ldx *waiting
        std 0,x
        inx
        inx
        cpx #captured+32
        beq cold
        stx *waiting
        rts

; Send the captured bytes of a frame.
        .globl tell_captured
tell_captured:
        ldx *sent
        ldaa 0,x
        inx
        stx *sent
        jsr put_byte
        dec several
        bne tell_captured
        rts

cold:   rts
