// SPDX-License-Identifier: LGPL-2.1-or-later

#include "height_map.h"

#include "input_error.h"
#include "number_text.h"
#include "parameters.h"

#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>

namespace abut::app
{
  namespace
  {
    /** Reads the parts of one PGM file and says what is wrong with it. */
    class PgmReader
    {
    public:
      PgmReader(const std::filesystem::path &file, std::string parameter)
          : in(file, std::ios::binary),
            file(file.string()),
            parameter(std::move(parameter))
      {
        if (!in || std::filesystem::is_directory(file))
          fail("cannot be opened");
      }

      GreyImage read()
      {
        std::string magic(2, ' ');
        in.read(magic.data(), 2);
        if (!in || (magic != "P2" && magic != "P5"))
          fail("is not a PGM image (it does not begin with P2 or P5)");
        GreyImage image;
        image.width = number("width", largest_side);
        image.height = number("height", largest_side);
        const std::size_t white = number("largest grey value", 65535);
        if (image.width == 0 || image.height == 0 || white == 0)
          fail("has width, height or largest grey value 0");
        require_bytes(image.width * image.height, magic == "P2", white);
        image.pixels.resize(image.width * image.height);
        if (magic == "P2")
          read_text(image, white);
        else
          read_binary(image, white);
        return image;
      }

    private:
      static constexpr std::size_t largest_side = 100000;

      [[noreturn]] void fail(const std::string &what) const
      {
        throw InputError(parameter, "the file '" + file + "' " + what + ".");
      }

      /** Next whole number, after blanks and comments. */
      std::size_t number(const std::string &name, const std::size_t largest)
      {
        int c = in.get();
        while (c == '#' || std::isspace(c))
        {
          if (c == '#')
            while (c != '\n' && c != EOF)
              c = in.get();
          c = in.get();
        }
        if (c == EOF)
          fail("ends before its " + name);
        if (!std::isdigit(c))
          fail("has no whole number for its " + name);
        std::size_t value = 0;
        for (; std::isdigit(c); c = in.get())
        {
          value = 10 * value + std::size_t(c - '0');
          if (value > largest)
            fail("has a " + name + " above " + std::to_string(largest));
        }
        // exactly one blank stands between the header and binary data
        return value;
      }

      /** Believe a header only as far as the file reaches: what it announces
       * may be more than the memory. */
      void require_bytes(const std::size_t n_pixels, const bool is_text,
                         const std::size_t white)
      {
        // A pixel of text is a digit and a blank, the last one a digit.
        const std::size_t needed = is_text       ? 2 * n_pixels - 1
                                   : white > 255 ? 2 * n_pixels
                                                 : n_pixels;
        const auto here = in.tellg();
        in.seekg(0, std::ios::end);
        const std::streamoff left = in.tellg() - here;
        in.seekg(here);
        if (left >= std::streamoff(needed))
          return;
        fail(is_text ? "ends before its last pixel"
                     : "is truncated: it has " + std::to_string(left) + " of "
                           + std::to_string(needed) + " bytes of pixels");
      }

      void read_text(GreyImage &image, const std::size_t white)
      {
        for (double &pixel : image.pixels)
          pixel = double(number("last pixel", white)) / double(white);
      }

      void read_binary(GreyImage &image, const std::size_t white)
      {
        const std::size_t width = white > 255 ? 2 : 1;
        std::vector<unsigned char> bytes(width * image.pixels.size());
        in.read(reinterpret_cast<char *>(bytes.data()),
                std::streamsize(bytes.size()));
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
        {
          const std::size_t grey =
              width == 1 ? bytes[i]
                         : 256 * std::size_t(bytes[2 * i]) + bytes[2 * i + 1];
          if (grey > white)
            fail("has a pixel above its largest grey value");
          image.pixels[i] = double(grey) / double(white);
        }
      }

      std::ifstream in;
      std::string file;
      std::string parameter;
    };

    dealii::Point<2> parse_corner(const std::string &text,
                                  const std::string &parameter)
    {
      const std::vector<double> numbers = parse_numbers(text, parameter);
      if (numbers.size() != 2)
        throw InputError(parameter, "'" + text + "' is not two numbers, x y."
                                        + misread_hint(text));
      return {numbers[0], numbers[1]};
    }
  } // namespace

  GreyImage read_pgm(const std::filesystem::path &file,
                     const std::string &parameter)
  {
    return PgmReader(file, parameter).read();
  }

  void HeightMapParameters::declare(dealii::ParameterHandler &prm)
  {
    parameter::declare(prm, "Height map", "", TextPattern::file(),
                       parameter::advanced("", "surface.pgm"),
                       "Grey-scale image (PGM, P2 or P5, 8 or 16 bits) whose "
                       "brightness is the height. A relative name is relative "
                       "to the scene file. Empty: none.");
    parameter::declare(prm, "Height map lower corner", "0, 0",
                       TextPattern::number_vector(),
                       parameter::advanced("length", "-1, -1"),
                       "x and y of the centre of the lower left pixel.");
    parameter::declare(prm, "Height map upper corner", "1, 1",
                       TextPattern::number_vector(),
                       parameter::advanced("length", "1, 1"),
                       "x and y of the centre of the upper right pixel. Points "
                       "outside have the height of the nearest pixel.");
    parameter::declare(prm, "Height map lowest", "0",
                       NumberPattern::between(-largest_value, largest_value),
                       parameter::advanced("length", "-0.2"),
                       "Height of black.");
    parameter::declare(prm, "Height map highest", "1",
                       NumberPattern::between(-largest_value, largest_value),
                       parameter::advanced("length", "0"), "Height of white.");
  }

  void HeightMapParameters::parse(dealii::ParameterHandler &prm,
                                  const std::string &section)
  {
    const std::string prefix = section.empty() ? "" : section + "/";
    parameter = prefix + "Height map";
    file = prm.get("Height map");
    lower = parse_corner(prm.get("Height map lower corner"),
                         prefix + "Height map lower corner");
    upper = parse_corner(prm.get("Height map upper corner"),
                         prefix + "Height map upper corner");
    lowest = prm.get_double("Height map lowest");
    highest = prm.get_double("Height map highest");
    if (!(upper[0] > lower[0] && upper[1] > lower[1]))
      throw InputError(prefix + "Height map upper corner",
                       "both coordinates must be larger than those of the "
                       "lower corner.");
  }

  template <int dim>
  HeightMap<dim>::HeightMap(const HeightMapParameters &parameters,
                            const std::filesystem::path &file)
      : image(read_pgm(file, parameters.parameter)),
        lower(parameters.lower),
        upper(parameters.upper),
        lowest(parameters.lowest),
        highest(parameters.highest)
  {
  }

  template <int dim>
  double HeightMap<dim>::value(const dealii::Point<dim> &point,
                               const unsigned int) const
  {
    // lattice coordinate in pixels, and the pixel before it
    const auto place = [](double s, std::size_t n, std::size_t &index)
    {
      const double last = double(n - 1);
      const double at = std::min(std::max(s * last, 0.), last);
      index = std::min(std::size_t(at), n > 1 ? n - 2 : 0);
      return at - double(index);
    };
    std::size_t i = 0;
    std::size_t j = 0;
    const double a =
        place((point[0] - lower[0]) / (upper[0] - lower[0]), image.width, i);
    const double b =
        place((upper[1] - point[1]) / (upper[1] - lower[1]), image.height, j);
    const std::size_t right = std::min(i + 1, image.width - 1);
    const double *row = image.pixels.data() + j * image.width;
    const double *next = j + 1 < image.height ? row + image.width : row;
    const double grey = (1 - b) * ((1 - a) * row[i] + a * row[right])
                        + b * ((1 - a) * next[i] + a * next[right]);
    return lowest + (highest - lowest) * grey;
  }

  template class HeightMap<2>;
  template class HeightMap<3>;
} // namespace abut::app
