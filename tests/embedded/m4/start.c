/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Start of a program on QEMU's mps2-an386 and its instruction counter.
 *
 * With -icount shift=6 QEMU lets 64 ns of virtual time pass for each instruction. SysTick
 * counts at 25 MHz, 1.6 ticks for each: the number of instructions between two readings
 * is exact, whatever the computer underneath does. QEMU loads .data in place.
 */
#include "counter.h"

#include <stdint.h>

#define TICKS_A_FIFTH 8 /* ticks in 5 instructions */

/* SysTick: ARMv7-M Architecture Reference Manual, B3.3 */
#define SYST_CSR (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018u)
#define CPACR (*(volatile uint32_t *)0xE000ED88u)

extern void _mainCRTStartup(void);
extern uint32_t __stack;
void m4_reset(void);
void m4_fault(void);

uint32_t counter_start(void)
{
    return SYST_CVR;
}

uint32_t counter_since(uint32_t start)
{
    const uint32_t ticks = (start - SYST_CVR) & 0xFFFFFFu;
    return (5u * ticks + TICKS_A_FIFTH / 2u) / TICKS_A_FIFTH;
}

void m4_reset(void)
{
    CPACR |= 0xFu << 20; /* the floating-point unit is on */
    __asm volatile("dsb\n\tisb");
    SYST_RVR = 0xFFFFFFu;
    SYST_CVR = 0u;
    SYST_CSR = 5u; /* core clock, no interrupt */
    _mainCRTStartup();
}

/* A fault ends the program loudly: semihosting call SYS_EXIT_EXTENDED with code 99. */
void m4_fault(void)
{
    static const uint32_t reason[2] = {0x20026u, 99u};
    register uint32_t call __asm("r0") = 0x20u;
    register const uint32_t *block __asm("r1") = reason;
    __asm volatile("bkpt 0xab" : : "r"(call), "r"(block) : "memory");
    for (;;) {
    }
}

__attribute__((section(".vectors"), used)) static const void *const vectors[16] = {
    &__stack, m4_reset, m4_fault, m4_fault, m4_fault, m4_fault, m4_fault, 0,
    0,        0,        0,        m4_fault, m4_fault, 0,        m4_fault, m4_fault};
