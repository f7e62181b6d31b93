// SPDX-License-Identifier: LGPL-2.1-or-later
#include "json.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <ostream>

namespace abut::app
{
  namespace
  {
    std::string json_string(const std::string &text)
    {
      std::string result = "\"";
      for (const char c : text)
        if (c == '"' || c == '\\')
          (result += '\\') += c;
        else if (static_cast<unsigned char>(c) < 0x20)
        {
          char escape[8];
          std::snprintf(escape, sizeof(escape), "\\u%04x", c);
          result += escape;
        }
        else
          result += c;
      return result + "\"";
    }
  } // namespace

  std::string json_number(const double value)
  {
    if (!std::isfinite(value))
      return "null";
    char text[40];
    // 0 has no sign.
    const auto result = std::to_chars(text, text + sizeof(text), value + 0.);
    return std::string(text, result.ptr);
  }

  JsonWriter::JsonWriter(std::ostream &out) : out(out)
  {
  }

  void JsonWriter::begin()
  {
    out << "{";
    empty.push_back(true);
  }

  void JsonWriter::begin(const std::string &name)
  {
    member(name);
    begin();
  }

  void JsonWriter::end()
  {
    const bool was_empty = empty.back();
    empty.pop_back();
    if (!was_empty)
      out << "\n" << std::string(2 * empty.size(), ' ');
    out << "}";
    if (empty.empty())
      out << "\n";
  }

  void JsonWriter::member(const std::string &name)
  {
    out << (empty.back() ? "\n" : ",\n") << std::string(2 * empty.size(), ' ')
        << json_string(name) << ": ";
    empty.back() = false;
  }

  void JsonWriter::value(const std::string &name, std::monostate)
  {
    member(name);
    out << "null";
  }

  void JsonWriter::value(const std::string &name, const bool value)
  {
    member(name);
    out << (value ? "true" : "false");
  }

  void JsonWriter::value(const std::string &name, const std::int64_t value)
  {
    member(name);
    out << value;
  }

  void JsonWriter::value(const std::string &name, const double value)
  {
    member(name);
    out << json_number(value);
  }

  void JsonWriter::value(const std::string &name, const std::string &value)
  {
    member(name);
    out << json_string(value);
  }

  void JsonWriter::value(const std::string &name,
                         const std::vector<double> &value)
  {
    member(name);
    out << "[";
    for (std::size_t i = 0; i < value.size(); ++i)
      out << (i == 0 ? "" : ", ") << json_number(value[i]);
    out << "]";
  }

  void JsonWriter::value(const std::string &name,
                         const std::vector<std::string> &value)
  {
    member(name);
    out << "[";
    for (std::size_t i = 0; i < value.size(); ++i)
      out << (i == 0 ? "" : ", ") << json_string(value[i]);
    out << "]";
  }
} // namespace abut::app
