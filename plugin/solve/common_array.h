// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_COMMON_ARRAY_H
#define ABUT_SOLVE_COMMON_ARRAY_H

#include <cstddef>
#include <memory>
#include <vector>

namespace abut::solve
{
  /** An array that all copies of an object have in common as long as none of
   * them changes it: of large meshes there is one. */
  template <typename T> class CommonArray
  {
  public:
    std::size_t size() const
    {
      return values_ == nullptr ? 0 : values_->size();
    }
    bool empty() const
    {
      return size() == 0;
    }
    const T &operator[](const std::size_t i) const
    {
      return (*values_)[i];
    }
    const T *begin() const
    {
      return values_ == nullptr ? nullptr : values_->data();
    }
    const T *end() const
    {
      return begin() + size();
    }

    /** The values of this copy alone, to be changed before others are made. */
    std::vector<T> &change()
    {
      if (values_ == nullptr)
        values_ = std::make_shared<std::vector<T>>();
      else if (values_.use_count() > 1)
        values_ = std::make_shared<std::vector<T>>(*values_);
      return *values_;
    }

  private:
    std::shared_ptr<std::vector<T>> values_;
  };
} // namespace abut::solve

#endif
