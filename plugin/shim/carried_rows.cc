// SPDX-License-Identifier: LGPL-2.1-or-later
// Old and new owner of a row do not know each other: they meet at a third rank,
// which follows from the row's number. O(rows / ranks) memory for balanced
// surfaces, three exchanges.
#include "carried_rows.h"

#include <deal.II/base/mpi.h>

#include <unordered_map>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Where to ask for a row. Numbers come in strides; their products by an
     * odd constant do not (Knuth, TAOCP 6.4). */
    unsigned int meeting_rank(const std::int64_t id, const unsigned int n_ranks)
    {
      const std::uint64_t scattered =
          static_cast<std::uint64_t>(id) * 0x9e3779b97f4a7c15u;
      return static_cast<unsigned int>((scattered >> 32) % n_ranks);
    }
  } // namespace

  void CarriedRows::keep(const std::uint64_t mesh, const abut_rows_view &rows,
                         std::vector<double> pressure)
  {
    is_kept_ = true;
    mesh_ = mesh;
    id_.assign(rows.id, rows.id + rows.n_rows);
    pressure_ = std::move(pressure);
  }

  void CarriedRows::clear()
  {
    *this = CarriedRows();
  }

  bool CarriedRows::find(const std::uint64_t mesh, const abut_rows_view &rows,
                         PointToPoint &post,
                         std::vector<double> &pressure) const
  {
    if (!is_kept_ || mesh != mesh_)
      return false;
    const MPI_Comm communicator = post.communicator();
    const unsigned int n_ranks = MPI::n_mpi_processes(communicator);

    Mail known;
    for (std::size_t i = 0; i < id_.size(); ++i)
    {
      Parcel &parcel = known[meeting_rank(id_[i], n_ranks)];
      parcel.write(id_[i]);
      parcel.write_value(pressure_[i]);
    }
    std::unordered_map<std::int64_t, double> met;
    for (auto &[rank, parcel] : post.exchange(known))
      while (!parcel.at_end())
      {
        const std::int64_t id = parcel.read();
        met[id] = parcel.read_value();
      }

    Mail questions, answers;
    for (std::int32_t i = 0; i < rows.n_rows; ++i)
      questions[meeting_rank(rows.id[i], n_ranks)].write(rows.id[i]);
    for (auto &[rank, question] : post.exchange(questions))
      while (!question.at_end())
      {
        const auto found = met.find(question.read());
        answers[rank].write_value(found != met.end() ? found->second : 0.);
      }
    Mail received = post.exchange(answers);
    pressure.resize(rows.n_rows);
    for (std::int32_t i = 0; i < rows.n_rows; ++i)
      pressure[i] = received[meeting_rank(rows.id[i], n_ranks)].read_value();
    return true;
  }
} // namespace abut::shim
