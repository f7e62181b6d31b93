// SPDX-License-Identifier: LGPL-2.1-or-later
#include "text_table.h"

#include <algorithm>
#include <iomanip>
#include <ostream>

namespace abut::app
{
  void TextTable::print(std::ostream &out) const
  {
    std::size_t n_columns = 0;
    for (const auto &row : rows)
      n_columns = std::max(n_columns, row.size());
    std::vector<std::size_t> widths(n_columns, 0);
    for (const auto &row : rows)
      for (std::size_t i = 0; i < row.size(); ++i)
        if (i + 1 < row.size() || row.size() == n_columns)
          widths[i] = std::max(widths[i], row[i].size());
    for (const auto &row : rows)
    {
      out << "  ";
      for (std::size_t i = 0; i < row.size(); ++i)
        out << (i > 0 ? "  " : "") << (i > 0 ? std::right : std::left)
            << std::setw(static_cast<int>(widths[i])) << row[i];
      out << "\n";
    }
  }
} // namespace abut::app
