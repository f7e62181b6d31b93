// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ARCHIVE_H
#define ABUT_APP_ARCHIVE_H

/** @file
 * How values become bytes of a checkpoint: by boost's binary archives, which
 * keep numbers bit by bit. A checkpoint is for the program that wrote it: no
 * versions, no other machines.
 */

#include <abut/dealii/linear_algebra.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <optional>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

namespace abut::app
{
  /** The bytes of @p value, which boost can serialise. */
  template <typename T> std::string to_bytes(const T &value)
  {
    std::ostringstream out(std::ios::binary);
    {
      boost::archive::binary_oarchive archive(out);
      archive << value;
    }
    return out.str();
  }

  /** Fill @p value from to_bytes(). Throws what boost throws if they are not
   * of a value of this type. */
  template <typename T> void from_bytes(const std::string &bytes, T &value)
  {
    std::istringstream in(bytes, std::ios::binary);
    boost::archive::binary_iarchive archive(in);
    archive >> value;
  }

  /** The entries of @p vector that this rank owns. */
  inline std::vector<double> owned_values(const la::Vector &vector)
  {
    const double *values = la::data(vector);
    return {values, values + la::n_owned(vector)};
  }

  /** The other way round; the vector must have its size. */
  inline void set_owned_values(const std::vector<double> &values,
                               la::Vector &vector)
  {
    std::copy(values.begin(), values.end(), la::data(vector));
  }
} // namespace abut::app

namespace boost::serialization
{
  template <class Archive, typename T>
  void save(Archive &archive, const std::optional<T> &value, unsigned int)
  {
    const bool is_there = value.has_value();
    archive << is_there;
    if (is_there)
      archive << *value;
  }

  template <class Archive, typename T>
  void load(Archive &archive, std::optional<T> &value, unsigned int)
  {
    bool is_there = false;
    archive >> is_there;
    value.reset();
    if (is_there)
      archive >> value.emplace();
  }

  template <class Archive, typename T>
  void serialize(Archive &archive, std::optional<T> &value,
                 const unsigned int version)
  {
    split_free(archive, value, version);
  }

  template <class Archive>
  void serialize(Archive &, std::monostate &, unsigned int)
  {
  }

  template <class Archive, typename... T>
  void save(Archive &archive, const std::variant<T...> &value, unsigned int)
  {
    const std::size_t which = value.index();
    archive << which;
    std::visit([&](const auto &alternative) { archive << alternative; }, value);
  }

  /** Load the alternative number @p which, of those from number i on. */
  template <class Archive, std::size_t i = 0, typename... T>
  void load_alternative(Archive &archive, const std::size_t which,
                        std::variant<T...> &value)
  {
    if constexpr (i < sizeof...(T))
    {
      if (which == i)
        archive >> value.template emplace<i>();
      else
        load_alternative<Archive, i + 1>(archive, which, value);
    }
  }

  template <class Archive, typename... T>
  void load(Archive &archive, std::variant<T...> &value, unsigned int)
  {
    std::size_t which = 0;
    archive >> which;
    load_alternative(archive, which, value);
  }

  template <class Archive, typename... T>
  void serialize(Archive &archive, std::variant<T...> &value,
                 const unsigned int version)
  {
    split_free(archive, value, version);
  }
} // namespace boost::serialization

#endif
