/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Runs a fuzz target on the files named on the command line, for compilers
 * without a fuzzer. */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int
main(int n, char **names)
{
  static uint8_t data[4096];
  if (n < 2)
    return 1;
  for (int i = 1; i < n; ++i)
  {
    FILE *file = fopen(names[i], "rb");
    if (!file)
    {
      fprintf(stderr, "%s: cannot be read\n", names[i]);
      return 1;
    }
    const size_t size = fread(data, 1, sizeof(data), file);
    fclose(file);
    (void)LLVMFuzzerTestOneInput(data, size);
  }
  return 0;
}
