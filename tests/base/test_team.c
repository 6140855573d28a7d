/* SPDX-License-Identifier: BSD-2-Clause */
#include "base/team.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define ITEMS 10000

typedef struct list {
    atomic_int next, shares;
    char done[ITEMS]; /* each item is one thread's */
} list;

static list todo;

static void share(void *user)
{
    list *l = user;
    int i;
    atomic_fetch_add(&l->shares, 1);
    while ((i = atomic_fetch_add(&l->next, 1)) < ITEMS)
        l->done[i]++;
}

static void every_item_is_done_once_by_any_number_of_threads(void **state)
{
    (void)state;
    const int threads[] = {1, 2, 3, 8, 64};
    for (size_t t = 0; t < sizeof threads / sizeof threads[0]; t++) {
        memset(todo.done, 0, sizeof todo.done);
        atomic_store(&todo.next, 0);
        atomic_store(&todo.shares, 0);
        gm_team_run(threads[t], share, &todo);
        for (int i = 0; i < ITEMS; i++)
            assert_int_equal(todo.done[i], 1);
        assert_true(atomic_load(&todo.shares) >= 1);
        assert_true(atomic_load(&todo.shares) <= threads[t]);
    }
}

static void remember(void *user)
{
    *(pthread_t *)user = pthread_self();
}

static void one_thread_is_the_callers(void **state)
{
    (void)state;
    pthread_t who;
    gm_team_run(1, remember, &who);
    assert_true(pthread_equal(who, pthread_self()));
    assert_true(gm_team_all() >= 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_item_is_done_once_by_any_number_of_threads),
        cmocka_unit_test(one_thread_is_the_callers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
