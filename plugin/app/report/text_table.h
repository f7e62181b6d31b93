// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_TEXT_TABLE_H
#define ABUT_APP_TEXT_TABLE_H

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace abut::app
{
  /** Rows of text whose columns are aligned: the first to the left, others to
   * the right. The last cell of a row that is shorter than others may reach
   * into the columns that it has not. */
  class TextTable
  {
  public:
    void add(std::vector<std::string> row)
    {
      rows.push_back(std::move(row));
    }

    /** Drop the rows behind the first @p n. */
    void keep(const std::size_t n)
    {
      rows.resize(n);
    }

    std::size_t size() const
    {
      return rows.size();
    }

    /** Each row a line that begins with two blanks. */
    void print(std::ostream &out) const;

  private:
    std::vector<std::vector<std::string>> rows;
  };
} // namespace abut::app

#endif
