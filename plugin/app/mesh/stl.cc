// SPDX-License-Identifier: LGPL-2.1-or-later
/* Reading STL files. A binary file is 80 bytes of anything, the number n of
 * triangles, and 50 bytes for each: normal and three vertices as 32-bit
 * numbers, and two bytes of anything. It may begin like a text file, so its
 * length decides. Text is
 *
 *     solid NAME
 *       facet normal a b c
 *         outer loop
 *           vertex x y z     (three times)
 *         endloop
 *       endfacet
 *     endsolid NAME
 */
#include "stl.h"

#include "app/input/input_error.h"
#include "app/input/number_text.h"
#include "cell_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>

namespace abut::app
{
  namespace
  {
    constexpr std::size_t header = 80, prefix = 84, triangle_size = 50;

    /** Corners closer than this part of a side are one vertex. */
    constexpr double joined_part = 1e-7;

    class Reader
    {
    public:
      Reader(const std::filesystem::path &file, const std::string &parameter)
          : file(file), parameter(parameter)
      {
        std::ifstream in(file, std::ios::binary);
        if (!in || std::filesystem::is_directory(file))
          complain("cannot be opened.");
        bytes.assign(std::istreambuf_iterator<char>(in), {});
      }

      Triangles read()
      {
        if (is_binary())
          read_binary();
        else
          read_text();
        if (corners.empty())
          complain("has no triangles.");
        join();
        return std::move(result);
      }

    private:
      [[noreturn]] void complain(const std::string &what) const
      {
        throw InputError(parameter,
                         "the surface file '" + file.string() + "' " + what);
      }

      /** 32-bit number at @p place, lowest byte first. */
      std::uint32_t bits_at(const std::size_t place) const
      {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
          value |= static_cast<std::uint32_t>(
                       static_cast<unsigned char>(bytes[place + i]))
                   << (8 * i);
        return value;
      }

      bool is_binary() const
      {
        return bytes.size() >= prefix
               && bytes.size()
                      == prefix + triangle_size * std::size_t(bits_at(header));
      }

      void add(const std::array<double, 3> &x, const std::string &where)
      {
        for (const double coordinate : x)
          if (!std::isfinite(coordinate))
            complain("has a coordinate that is not finite " + where + ".");
        corners.push_back(x);
      }

      /** The shortest side at a corner that is not 0. */
      double shortest_side(const std::size_t corner) const
      {
        const std::size_t first = corner - corner % 3;
        double shortest = std::numeric_limits<double>::infinity();
        for (std::size_t other = first; other < first + 3; ++other)
        {
          const double side = distance(corners[corner], corners[other]);
          if (side > 0.)
            shortest = std::min(shortest, side);
        }
        return std::isfinite(shortest) ? shortest : 0.;
      }

      /** Number the vertices: corners become one that are closer than a part of
       * the shortest side at either of them. Corners are looked for in cubes
       * four times as large as the largest of these distances. */
      void join()
      {
        std::vector<double> reach(corners.size());
        for (std::size_t c = 0; c < corners.size(); ++c)
          reach[c] = joined_part * shortest_side(c);
        const double size = 4. * *std::max_element(reach.begin(), reach.end());
        const auto cube = [size](const double x)
        { return size > 0. ? std::floor(x / size) : x + 0.; };
        std::map<std::array<double, 3>, std::vector<std::int32_t>> cubes;
        std::vector<double> kept; // reach of each vertex
        for (std::size_t c = 0; c < corners.size(); ++c)
        {
          const std::array<double, 3> &x = corners[c];
          std::int32_t number = -1;
          for (int k = 0; k < 8 && number < 0; ++k)
          {
            std::array<double, 3> at;
            bool is_new = true;
            for (unsigned int d = 0; d < 3; ++d)
            {
              at[d] = cube(x[d] + ((k >> d & 1) != 0 ? reach[c] : -reach[c]));
              is_new = is_new
                       && ((k >> d & 1) == 0 || at[d] != cube(x[d] - reach[c]));
            }
            const auto found = is_new ? cubes.find(at) : cubes.end();
            if (found == cubes.end())
              continue;
            for (const std::int32_t v : found->second)
              if (distance(result.vertices[v], x)
                  <= std::min(kept[v], reach[c]))
              {
                number = v;
                break;
              }
          }
          if (number < 0)
          {
            number = static_cast<std::int32_t>(result.vertices.size());
            cubes[{{cube(x[0]), cube(x[1]), cube(x[2])}}].push_back(number);
            result.vertices.push_back(x);
            kept.push_back(reach[c]);
          }
          result.connectivity.push_back(number);
        }
      }

      void read_binary()
      {
        const std::size_t n = bits_at(header);
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t v = 0; v < 3; ++v)
          {
            std::array<double, 3> x;
            for (std::size_t d = 0; d < 3; ++d)
            {
              const std::uint32_t bits =
                  bits_at(prefix + triangle_size * i + 12 * (v + 1) + 4 * d);
              float value;
              std::memcpy(&value, &bits, sizeof value);
              x[d] = static_cast<double>(value);
            }
            add(x, "in triangle " + std::to_string(i));
          }
      }

      /** Three numbers and nothing else. */
      std::array<double, 3> numbers_after_vertex(std::istringstream &words,
                                                 const std::string &where) const
      {
        std::array<double, 3> x{};
        std::size_t n = 0;
        for (std::string word; words >> word; ++n)
        {
          char *end = nullptr;
          const double value = std::strtod(word.c_str(), &end);
          if (*end != '\0')
            complain("has '" + word + "', which is not a number, " + where + "."
                     + misread_hint(word));
          if (!std::isfinite(value))
            complain("has '" + word + "', which is not a finite number, "
                     + where + ".");
          if (n < 3)
            x[n] = value;
        }
        if (n != 3)
          complain("has " + std::to_string(n) + " numbers after 'vertex' "
                   + where + "; it needs three.");
        return x;
      }

      void read_text()
      {
        std::istringstream in(bytes);
        std::string line, word;
        std::size_t number = 0, n_in_loop = 0;
        bool begun = false;
        while (std::getline(in, line))
        {
          ++number;
          const std::string where = "in line " + std::to_string(number);
          std::istringstream words(line);
          if (!(words >> word))
            continue;
          if (!begun && word != "solid")
            complain("is neither a text file that begins with 'solid' nor as "
                     "long as a binary one must be (84 bytes and 50 for each "
                     "triangle).");
          begun = true;
          if (word == "vertex")
          {
            add(numbers_after_vertex(words, where), where);
            ++n_in_loop;
          }
          else if (word == "endloop" || word == "endfacet")
          {
            if (word == "endloop" && n_in_loop != 3)
              complain("has a loop of " + std::to_string(n_in_loop)
                       + " vertices " + where + ".");
            n_in_loop = 0;
          }
          else if (word != "solid" && word != "facet" && word != "outer"
                   && word != "endsolid")
            complain("has the unknown word '" + word + "' " + where + ".");
        }
        if (n_in_loop != 0)
          complain("ends within a triangle.");
      }

      const std::filesystem::path file;
      const std::string parameter;
      std::string bytes;
      std::vector<std::array<double, 3>> corners; ///< three per triangle
      Triangles result;
    };
  } // namespace

  Triangles read_stl(const std::filesystem::path &file,
                     const std::string &parameter)
  {
    return Reader(file, parameter).read();
  }
} // namespace abut::app
