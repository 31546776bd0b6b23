; What goes to the host: telemetry, and captured samples.
        .include "board.inc"
        .text

; The head of a frame that goes: address, number, type, time, state, fault, switches, and the index
; of the segment that comes next.
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

; Telemetry of one axis (X: its encoder): 24 bits, and how far the command is from that.
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
        bvs cold                    ; it does not fit: clipped
        pshb
        jsr put_byte
        pula
        jsr put_byte
        rts

; The end of a frame that goes: its check, the length of its last stretch, the line's interrupt.
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

; A captured sample of one axis: 16 bits into those that wait.
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

; Captured samples go: one byte of theirs.
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
