/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Runs a fuzz target on the files named on the command line and on inputs made
 * from them by random changes, always the same ones, for compilers without a
 * fuzzer. An input that fails is kept in the file replay-failed. */
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum
{
  N_CHANGED = 200, /* inputs from each file */
  ROOM = 4096
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static uint8_t present[ROOM];
static size_t present_size;

static uint32_t
below(uint64_t *state, uint32_t n)
{
  *state ^= *state << 13;
  *state ^= *state >> 7;
  *state ^= *state << 17;
  return (uint32_t)((*state >> 32) % n);
}

/* Other bytes, a copied piece, or a shorter input. */
static void
change(uint64_t *state)
{
  const uint32_t size = (uint32_t)present_size;
  if (size < 2)
    return;
  const uint32_t at = below(state, size), from = below(state, size);
  const uint32_t largest = at > from ? at : from;
  switch (below(state, 8))
  {
  case 0:
    memmove(present + at, present + from, below(state, size - largest) + 1);
    break;
  case 1:
    present_size = at + 1;
    break;
  case 2:
    present[at] = (uint8_t)(below(state, 2) * 255);
    break;
  case 3:
    present[at] ^= (uint8_t)(1u << below(state, 8));
    break;
  default:
    present[at] = (uint8_t)below(state, 256);
  }
}

static void
keep(int number)
{
  FILE *file = fopen("replay-failed", "wb");
  if (file)
  {
    (void)fwrite(present, 1, present_size, file);
    fclose(file);
  }
  signal(number, SIG_DFL);
  raise(number);
}

static int
replay(const char *name)
{
  static uint8_t data[ROOM];
  FILE *file = fopen(name, "rb");
  if (!file)
  {
    fprintf(stderr, "%s: cannot be read\n", name);
    return 1;
  }
  const size_t size = fread(data, 1, sizeof(data), file);
  fclose(file);
  uint64_t state = 0x9e3779b97f4a7c15u;
  for (int i = 0; i <= N_CHANGED; ++i)
  {
    memcpy(present, data, size);
    present_size = size;
    const uint32_t n_changes = i == 0 ? 0 : 1 + below(&state, 6);
    for (uint32_t k = 0; k < n_changes; ++k)
      change(&state);
    (void)LLVMFuzzerTestOneInput(present, present_size);
  }
  return 0;
}

int
main(int n, char **names)
{
  signal(SIGABRT, keep);
  signal(SIGSEGV, keep);
  signal(SIGFPE, keep);
  for (int i = 1; i < n; ++i)
    if (replay(names[i]) != 0)
      return 1;
  return n < 2;
}
