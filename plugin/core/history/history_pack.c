/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* A version of a history as bytes.
 *
 * The head is followed by the arrays id (int64), pressure, place (double) and
 * state (uint8). A later format adds arrays and raises format_version; what
 * this one has is read then as it is now. The sum is Fowler, Noll and Vo's hash
 * of all bytes with the sum itself taken as 0. */
#include "history/history.h"

#include <math.h>
#include <string.h>

enum
{
  format_version = 1,
  byte_order = 0x01020304,
  entry_bytes = 8 + 8 + 24 + 1
};

static const char magic[8] = {'a', 'b', 'u', 't', '-', 'h', 'i', 's'};

typedef struct
{
  char magic[8];
  uint32_t byte_order;
  uint32_t version;
  uint32_t head_bytes;
  uint32_t entry_bytes;
  int64_t n;
  uint64_t bytes; /* of all */
  uint64_t mesh;
  char law[ABUT_HISTORY_LAW_BYTES];
  double first_penalty;
  double penalty;
  int64_t resumes;
  uint64_t sum;
} head;

static uint64_t
hash(uint64_t value, const void *data, size_t bytes)
{
  const unsigned char *at = data;
  for (size_t i = 0; i < bytes; ++i)
    value = (value ^ at[i]) * UINT64_C(1099511628211);
  return value;
}

static uint64_t
sum_of(head h, const void *body, size_t bytes)
{
  h.sum = 0;
  return hash(hash(UINT64_C(14695981039346656037), &h, sizeof(h)), body, bytes);
}

static head
make_head(const abut_entry_set *set)
{
  head h;
  memset(&h, 0, sizeof(h));
  memcpy(h.magic, magic, sizeof(magic));
  h.byte_order = byte_order;
  h.version = format_version;
  h.head_bytes = sizeof(head);
  h.entry_bytes = entry_bytes;
  h.n = set->n;
  h.bytes = sizeof(head) + (uint64_t)set->n * entry_bytes;
  h.mesh = set->problem.mesh;
  memcpy(h.law, set->problem.law, sizeof(h.law));
  h.first_penalty = set->problem.first_penalty;
  h.penalty = set->problem.penalty;
  h.resumes = set->problem.resumes;
  return h;
}

abut_status
abut_history_pack(const abut_history *history, abut_history_version version,
                  void *buffer, size_t *bytes)
{
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (bytes == NULL
      || (version != ABUT_HISTORY_COMMITTED && version != ABUT_HISTORY_TRIAL))
    return abut_fail(history->context, ABUT_INVALID_ARGUMENT,
                     "abut_history_pack", "bytes is NULL or the version wrong");
  const abut_entry_set *set =
      version == ABUT_HISTORY_COMMITTED ? &history->committed : &history->trial;
  head h = make_head(set);
  const size_t needed = (size_t)h.bytes, given = *bytes;
  *bytes = needed;
  if (buffer == NULL)
    return ABUT_SUCCESS;
  if (given < needed)
    return abut_fail(history->context, ABUT_INVALID_ARGUMENT,
                     "abut_history_pack", "the buffer is too small");
  char *body = (char *)buffer + sizeof(head), *at = body;
  const struct
  {
    const void *data;
    size_t element;
  } arrays[] = {{set->id.data, 8},
                {set->pressure.data, 8},
                {set->has_places ? set->place.data : NULL, 24},
                {set->state.data, 1}};
  for (int i = 0; i < 4 && set->n > 0; ++i)
  {
    const size_t size = (size_t)set->n * arrays[i].element;
    if (arrays[i].data == NULL)
      memset(at, 0, size);
    else
      memcpy(at, arrays[i].data, size);
    at += size;
  }
  h.sum = sum_of(h, body, needed - sizeof(head));
  memcpy(buffer, &h, sizeof(h));
  return ABUT_SUCCESS;
}

/* Error in a head; NULL: none. */
static const char *
fault_of(const head *h, const void *body, size_t bytes)
{
  if (memcmp(h->magic, magic, sizeof(magic)) != 0)
    return "these bytes are not a contact history";
  if (h->byte_order != byte_order)
    return "the history was written by a machine with another byte order";
  if (h->version != format_version)
    return "the history has another version of the format; it was written by "
           "another version of this library";
  if (h->head_bytes != sizeof(head) || h->entry_bytes != entry_bytes || h->n < 0
      || (uint64_t)h->n > UINT64_MAX / 2 / entry_bytes
      || h->bytes != sizeof(head) + (uint64_t)h->n * entry_bytes)
    return "sizes in the head of the history contradict each other: it is "
           "damaged";
  if (h->bytes != bytes)
    return "the history is cut off, or followed by other bytes";
  if (h->sum != sum_of(*h, body, bytes - sizeof(head)))
    return "the history is damaged: its sum is wrong";
  if (memchr(h->law, 0, sizeof(h->law)) == NULL || !isfinite(h->first_penalty)
      || !isfinite(h->penalty) || h->resumes < 0 || h->resumes > 1)
    return "the head of the history is damaged";
  return NULL;
}

/* Whether any of n entries of a body has a place but (0, 0, 0). */
static int
have_places(const char *body, int64_t n)
{
  const char *places = body + 16 * (size_t)n;
  for (size_t i = 0; i < 24 * (size_t)n; ++i)
    if (places[i] != 0)
      return 1;
  return 0;
}

/* Entries of a body into a set, whose room is enough. */
static void
read_entries(const char *body, int64_t n, abut_entry_set *set)
{
  const size_t size = (size_t)n;
  if (n == 0)
    return;
  memcpy(set->id.data, body, 8 * size);
  memcpy(set->pressure.data, body + 8 * size, 8 * size);
  if (set->has_places)
    memcpy(set->place.data, body + 16 * size, 24 * size);
  memcpy(set->state.data, body + 40 * size, size);
}

static abut_history_problem
problem_of(const head *h)
{
  abut_history_problem problem;
  memset(&problem, 0, sizeof(problem));
  problem.struct_size = sizeof(problem);
  problem.mesh = h->mesh;
  memcpy(problem.law, h->law, sizeof(h->law));
  problem.first_penalty = h->first_penalty;
  problem.penalty = h->penalty;
  problem.resumes = (int32_t)h->resumes;
  return problem;
}

abut_status
abut_history_unpack(abut_history *history, const void *buffer, size_t bytes)
{
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_context *context = history->context;
  const char *call = "abut_history_unpack";
  if (buffer == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, "buffer is NULL");
  if (bytes < sizeof(head))
    return abut_fail(
        context, ABUT_INVALID_ARGUMENT, call,
        "too few bytes for a contact history: it is cut off, or not one");
  head h;
  memcpy(&h, buffer, sizeof(h));
  const char *body = (const char *)buffer + sizeof(head);
  const char *fault = fault_of(&h, body, bytes);
  if (fault != NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, fault);

  /* Into the spare set first, so that nothing changes if it fails. */
  abut_entry_set *spare = &history->spare;
  spare->n = 0;
  spare->has_places = have_places(body, h.n);
  abut_status status = abut_entry_set_reserve(context, spare, h.n);
  if (status == ABUT_SUCCESS)
    status = abut_entry_set_reserve(context, &history->committed, h.n);
  if (status == ABUT_SUCCESS && spare->has_places)
    status = abut_entry_set_reserve_places(context, &history->committed, h.n);
  if (status != ABUT_SUCCESS)
    return status;
  read_entries(body, h.n, spare);
  const abut_history_entries entries = {
      sizeof(entries),   h.n,
      spare->id.data,    spare->pressure.data,
      spare->state.data, spare->has_places ? spare->place.data : NULL};
  status = abut_entries_check(context, call, &entries);
  if (status != ABUT_SUCCESS)
    return ABUT_INVALID_ARGUMENT;
  spare->n = h.n;
  spare->problem = problem_of(&h);
  const abut_entry_set trial = *spare;
  *spare = history->trial;
  history->trial = trial;
  return abut_history_commit(history);
}
