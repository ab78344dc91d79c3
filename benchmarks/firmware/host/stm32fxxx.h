/* What code of the firmware that runs on the host asks of the processor: never in an interrupt. */
#ifndef HOST_STM32FXXX_H
#define HOST_STM32FXXX_H
#include <stdint.h>
typedef int GPIO_TypeDef, TIM_TypeDef, DMA_Stream_TypeDef, TIM_OCInitTypeDef, TIM_TimeBaseInitTypeDef, GPIO_InitTypeDef;
#define SCB_ICSR_VECTACTIVE_Msk 0x1ffU
#define SCB (&(const struct { unsigned int ICSR; }){0})
#endif
