// SPDX-License-Identifier: LGPL-2.1-or-later
#include "file_mesh.h"

#include "app/input/number_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace abut::app
{
  namespace
  {
    bool is_space(const char c)
    {
      return std::isspace(static_cast<unsigned char>(c)) != 0;
    }

    std::string trimmed(const std::string &text, std::size_t begin,
                        std::size_t end)
    {
      while (begin < end && is_space(text[begin]))
        ++begin;
      while (end > begin && is_space(text[end - 1]))
        --end;
      return text.substr(begin, end - begin);
    }
  } // namespace

  const ShapeInfo &shape_info(const CellShape shape)
  {
    static const ShapeInfo all[] = {
        {"line", "lines", 1, 2, {{{0, 1}}}, {}},
        {"triangle",
         "triangles",
         2,
         3,
         {{{0, 1}}, {{1, 2}}, {{2, 0}}},
         {{0, 1}, {1, 2}, {2, 0}}},
        {"quadrilateral",
         "quadrilaterals",
         2,
         4,
         {{{0, 1}}, {{1, 2}}, {{2, 3}}, {{3, 0}}},
         {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
        {"tetrahedron",
         "tetrahedra",
         3,
         4,
         {{{0, 1}}, {{1, 2}}, {{2, 0}}, {{0, 3}}, {{1, 3}}, {{2, 3}}},
         {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}},
        {"hexahedron",
         "hexahedra",
         3,
         8,
         {{{0, 1}},
          {{1, 2}},
          {{2, 3}},
          {{3, 0}},
          {{4, 5}},
          {{5, 6}},
          {{6, 7}},
          {{7, 4}},
          {{0, 4}},
          {{1, 5}},
          {{2, 6}},
          {{3, 7}}},
         {{0, 1, 2, 3},
          {4, 7, 6, 5},
          {0, 4, 5, 1},
          {1, 5, 6, 2},
          {2, 6, 7, 3},
          {3, 7, 4, 0}}}};
    return all[static_cast<std::size_t>(shape)];
  }

  std::string first_line(const std::filesystem::path &file)
  {
    std::ifstream in(file);
    std::string line;
    while (std::getline(in, line))
    {
      line = trimmed(line, 0, line.size());
      if (!line.empty())
        return line;
    }
    return "";
  }

  FileLines::FileLines(const std::filesystem::path &file)
  {
    std::ifstream in(file, std::ios::binary);
    if (!in)
      throw MeshFileError("it cannot be opened.");
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }

  bool FileLines::next()
  {
    while (place < bytes.size())
    {
      const std::size_t end = std::min(bytes.find('\n', place), bytes.size());
      current = trimmed(bytes, place, end);
      place = end + 1;
      ++line;
      if (!current.empty())
        return true;
    }
    return false;
  }

  std::vector<std::string> FileLines::words(const char separator) const
  {
    std::vector<std::string> result;
    const auto separates = [separator](const char c)
    { return separator == ' ' ? is_space(c) : c == separator; };
    for (std::size_t begin = 0; begin < current.size();)
    {
      std::size_t end = begin;
      while (end < current.size() && !separates(current[end]))
        ++end;
      if (separator != ' ' || end > begin)
        result.push_back(trimmed(current, begin, end));
      begin = end + 1;
    }
    return result;
  }

  void FileLines::complain(const std::string &what) const
  {
    throw MeshFileError("in line " + std::to_string(line) + ", " + what);
  }

  double FileLines::real(const std::string &word) const
  {
    std::string text = word;
    const std::size_t exponent = text.find_first_of("dD");
    if (exponent != std::string::npos)
      text[exponent] = 'e';
    char *end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0'
        || text.find_first_of("xX") != std::string::npos)
      complain("'" + word + "' is not a number." + misread_hint(word));
    if (!std::isfinite(value))
      complain("'" + word + "' is not a finite number.");
    return value;
  }

  std::int64_t FileLines::whole(const std::string &word) const
  {
    constexpr std::size_t most_digits = 18;
    const std::size_t sign = !word.empty() && word[0] == '-' ? 1 : 0;
    if (!are_digits(word.substr(sign)))
      complain("'" + word + "' is not a whole number.");
    if (word.size() > most_digits)
      complain("the number " + word + " is too large.");
    return std::atoll(word.c_str());
  }

  std::vector<std::int64_t>
  FileLines::wholes(const std::vector<std::string> &words,
                    const std::size_t first) const
  {
    std::vector<std::int64_t> result;
    for (std::size_t i = first; i < words.size(); ++i)
      result.push_back(whole(words[i]));
    return result;
  }
} // namespace abut::app
