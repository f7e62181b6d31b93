// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_JSON_H
#define ABUT_APP_JSON_H

#include <cstdint>
#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

namespace abut::app
{
  /** Shortest decimal text that reads back as @p value, with "null" for NaN
   * and infinity. */
  std::string json_number(double value);

  /** Writes objects as JSON text (RFC 8259), one member a line. */
  class JsonWriter
  {
  public:
    explicit JsonWriter(std::ostream &out);

    /** Begin the object, or a member that is an object. */
    void begin();
    void begin(const std::string &name);

    /** End the present object. */
    void end();

    /** @name Members @{ */
    void value(const std::string &name, std::monostate);
    void value(const std::string &name, bool value);
    void value(const std::string &name, std::int64_t value);
    void value(const std::string &name, double value);
    void value(const std::string &name, const std::string &value);
    void value(const std::string &name, const std::vector<double> &value);
    void value(const std::string &name, const std::vector<std::string> &value);
    /** @} */

  private:
    void member(const std::string &name);

    std::ostream &out;
    std::vector<bool> empty; /**< of the open objects: no member so far */
  };
} // namespace abut::app

#endif
