// SPDX-License-Identifier: LGPL-2.1-or-later
// The history of contact as one stream of bytes: a head, then what each rank
// has, with its size before it. Any number of ranks can read it, because a
// point finds its entry by way of a third rank wherever that was read.
#include "contact_history.h"

#include "agree.h"
#include "fnv_hash.h"

#include <abut/dealii/contact_assembler.h>

#include <cstring>
#include <istream>
#include <ostream>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    using Bytes = std::vector<char>;

    struct Head
    {
      char magic[8];
      std::uint32_t byte_order, version;
      std::uint64_t n_parts, bytes; ///< of all parts with their sizes
      std::uint64_t sum;            ///< of the numbers above
    };

    constexpr char magic[8] = {'a', 'b', 'u', 't', '-', 's', 'e', 't'};
    constexpr std::uint32_t byte_order = 0x01020304, version = 2;

    std::uint64_t sum_of(const Head &head)
    {
      FnvHash hash;
      hash.mix(head.n_parts);
      hash.mix(head.bytes);
      return hash.value;
    }

    void write(std::ostream &stream, const std::vector<Bytes> &parts)
    {
      Head head = {};
      std::memcpy(head.magic, magic, sizeof(magic));
      head.byte_order = byte_order;
      head.version = version;
      head.n_parts = parts.size();
      for (const Bytes &part : parts)
        head.bytes += sizeof(std::uint64_t) + part.size();
      head.sum = sum_of(head);
      stream.write(reinterpret_cast<const char *>(&head), sizeof(head));
      for (const Bytes &part : parts)
      {
        const std::uint64_t size = part.size();
        stream.write(reinterpret_cast<const char *>(&size), sizeof(size));
        stream.write(part.data(), static_cast<std::streamsize>(size));
      }
      stream.flush();
      if (!stream.good())
        throw HistoryError("The history of contact could not be written.");
    }

    /** Fill @p bytes, or throw. */
    void read(std::istream &stream, char *bytes, const std::uint64_t n)
    {
      stream.read(bytes, static_cast<std::streamsize>(n));
      if (!stream.good() || stream.gcount() != static_cast<std::streamsize>(n))
        throw HistoryError("The history of contact is cut off.");
    }

    Head read_head(std::istream &stream)
    {
      Head head = {};
      if (!stream.good() || stream.peek() == std::istream::traits_type::eof())
        throw HistoryError("There is no history of contact in the stream: it "
                           "is empty or not open.");
      read(stream, reinterpret_cast<char *>(&head), sizeof(head));
      if (std::memcmp(head.magic, magic, sizeof(magic)) != 0)
        throw HistoryError(
            "This is not a contact history written by ContactState::save().");
      if (head.byte_order != byte_order)
        throw HistoryError("The contact history was written by a machine with "
                           "another byte order.");
      if (head.version != version)
        throw HistoryError("The history of contact has version "
                           + std::to_string(head.version) + ", not "
                           + std::to_string(version)
                           + ": it was written by another version of Abut.");
      if (head.sum != sum_of(head) || head.n_parts == 0)
        throw HistoryError("The head of the history of contact is damaged.");
      return head;
    }

    std::vector<Bytes> read_parts(std::istream &stream)
    {
      const Head head = read_head(stream);
      std::uint64_t left = head.bytes;
      std::vector<Bytes> parts;
      for (std::uint64_t i = 0; i < head.n_parts; ++i)
      {
        std::uint64_t size = 0;
        if (left < sizeof(size))
          throw HistoryError("The history of contact is damaged.");
        read(stream, reinterpret_cast<char *>(&size), sizeof(size));
        left -= sizeof(size);
        if (size > left)
          throw HistoryError("The history of contact is damaged.");
        parts.emplace_back(size);
        read(stream, parts.back().data(), size);
        left -= size;
      }
      return parts;
    }

    /** An exception of @p function on rank 0 is thrown on all ranks; it is
     * called there alone. Collective. */
    template <typename Function>
    void run_on_first(const MPI_Comm communicator, const Function &function)
    {
      run_everywhere<HistoryError>(communicator,
                                   [&]
                                   {
                                     if (MPI::this_mpi_process(communicator)
                                         == 0)
                                       function();
                                   });
    }

    /** The parts of rank 0 dealt out among the ranks. Collective. */
    std::vector<Bytes> deal_out(const MPI_Comm communicator,
                                std::vector<Bytes> parts)
    {
      const unsigned int n_ranks = MPI::n_mpi_processes(communicator);
      std::map<unsigned int, std::vector<Bytes>> mail;
      for (std::size_t i = 0; i < parts.size(); ++i)
        mail[static_cast<unsigned int>(i % n_ranks)].push_back(
            std::move(parts[i]));
      std::vector<Bytes> mine;
      for (auto &[rank, received] : MPI::some_to_some(communicator, mail))
        mine.insert(mine.end(), received.begin(), received.end());
      return mine;
    }

    void check_unpacked(const abut_context *context, const abut_status status)
    {
      if (status != ABUT_SUCCESS)
        throw HistoryError(message_of(context, status) + ".");
    }

    /** Put the entries of @p from into the trial version of @p to. */
    void merge(const abut_context *context, const abut_history *from,
               abut_history *to)
    {
      abut_history_entries entries = {};
      entries.struct_size = sizeof(entries);
      check_unpacked(context,
                     abut_history_view(from, ABUT_HISTORY_TRIAL, &entries));
      check_unpacked(context, abut_history_set(to, &entries));
    }
  } // namespace

  void ContactHistory::save(std::ostream &stream)
  {
    std::size_t size = 0;
    check(context_, abut_history_pack(history_.get(), ABUT_HISTORY_COMMITTED,
                                      nullptr, &size));
    Bytes mine(size);
    check(context_, abut_history_pack(history_.get(), ABUT_HISTORY_COMMITTED,
                                      mine.data(), &size));
    const std::vector<Bytes> all = MPI::gather(post_.communicator(), mine);
    run_on_first(post_.communicator(), [&] { write(stream, all); });
  }

  void ContactHistory::load(std::istream &stream, const std::uint64_t mesh,
                            const std::function<void()> &read_rest)
  {
    const MPI_Comm communicator = post_.communicator();
    std::vector<Bytes> parts;
    run_on_first(communicator, [&] { parts = read_parts(stream); });
    read_rest();
    parts = deal_out(communicator, std::move(parts));

    Handle<abut_history> loaded = create_history(context_),
                         part = create_history(context_);
    abut_history_problem known = {};
    known.struct_size = sizeof(known);
    run_everywhere<HistoryError>(
        communicator,
        [&]
        {
          for (const Bytes &bytes : parts)
          {
            check_unpacked(
                context_,
                abut_history_unpack(part.get(), bytes.data(), bytes.size()));
            check_unpacked(
                context_, abut_history_get_problem(part.get(),
                                                   ABUT_HISTORY_TRIAL, &known));
            if (known.mesh != 0 && known.mesh != mesh)
              throw HistoryError(
                  "The contact history belongs to another mesh, to the same "
                  "in a triangulation of another type, where cells have other "
                  "numbers, or to other surfaces. Transfer the pressure "
                  "as a field instead (ContactState::set_pressure()).");
            merge(context_, part.get(), loaded.get());
          }
        });
    // Rank 0 has a part in any case.
    const auto *first = reinterpret_cast<const char *>(&known);
    const Bytes all =
        MPI::broadcast(communicator, Bytes(first, first + sizeof(known)));
    std::memcpy(&known, all.data(), sizeof(known));
    check(context_,
          abut_history_set_problem(loaded.get(), ABUT_HISTORY_TRIAL, &known));
    check(context_, abut_history_commit(loaded.get()));
    history_ = std::move(loaded);
    is_here_ = {{false, false}};
  }
} // namespace abut::shim
