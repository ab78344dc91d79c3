/* Tasks, queues and semaphores of FreeRTOS on the host: coroutines that take turns, once a tick, in order of priority. */
#ifndef HOST_FREERTOS_H
#define HOST_FREERTOS_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "cfassert.h"
#include "config.h"

typedef int BaseType_t, portBASE_TYPE;
typedef unsigned int UBaseType_t;
typedef uint32_t TickType_t, portTickType, StackType_t;
typedef int StaticTask_t, StaticQueue_t, StaticSemaphore_t, StaticTimer_t;
typedef struct host_queue *QueueHandle_t, *xQueueHandle, *SemaphoreHandle_t, *xSemaphoreHandle;
typedef void *TaskHandle_t, *xTaskHandle, *TimerHandle_t, *xTimerHandle;

#define pdTRUE 1
#define pdFALSE 0
#define pdPASS 1
#define errQUEUE_FULL 0
#define portMAX_DELAY 0xffffffffU
#define configTICK_RATE_HZ 1000
#define configMINIMAL_STACK_SIZE 150
#define configMAX_PRIORITIES 6
#define tskIDLE_PRIORITY 0
#define M2T(X) ((unsigned int)(X))
#define T2M(X) ((unsigned int)(X))
#define F2T(X) ((unsigned int)(configTICK_RATE_HZ / (X)))
#define taskENTER_CRITICAL()
#define taskEXIT_CRITICAL()
#define portYIELD()
#define vTaskSetApplicationTaskTag(TASK, TAG)

TickType_t xTaskGetTickCount(void);
TaskHandle_t xTaskCreateStatic(void (*run)(void *), const char *name, int depth, void *argument, int priority,
                               StackType_t *stack, StaticTask_t *memory);
void vTaskDelay(TickType_t ticks);
void vTaskDelayUntil(TickType_t *woken, TickType_t ticks);
QueueHandle_t host_queue_create(int length, int size, int count);
int host_queue_send(QueueHandle_t queue, const void *item, bool overwrite);
int host_queue_take(QueueHandle_t queue, void *item, TickType_t ticks, bool keep);
#define xQueueCreate(LENGTH, SIZE) host_queue_create((int)(LENGTH), (int)(SIZE), 0)
#define xQueueCreateStatic(LENGTH, SIZE, STORAGE, MEMORY) ((void)(STORAGE), (void)(MEMORY), xQueueCreate(LENGTH, SIZE))
#define xQueueSend(QUEUE, ITEM, TICKS) host_queue_send(QUEUE, ITEM, false)
#define xQueueSendFromISR(QUEUE, ITEM, WOKEN) host_queue_send(QUEUE, ITEM, false)
#define xQueueOverwrite(QUEUE, ITEM) host_queue_send(QUEUE, ITEM, true)
#define xQueuePeek(QUEUE, ITEM, TICKS) host_queue_take(QUEUE, ITEM, TICKS, true)
#define xQueueReceive(QUEUE, ITEM, TICKS) host_queue_take(QUEUE, ITEM, TICKS, false)
#define xSemaphoreCreateBinary() host_queue_create(1, 0, 0)
#define xSemaphoreCreateMutex() host_queue_create(1, 0, 1)
#define xSemaphoreCreateMutexStatic(MEMORY) ((void)(MEMORY), xSemaphoreCreateMutex())
#define xSemaphoreTake(QUEUE, TICKS) host_queue_take(QUEUE, NULL, TICKS, false)
#define xSemaphoreGive(QUEUE) host_queue_send(QUEUE, NULL, false)
#endif
