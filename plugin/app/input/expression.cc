// SPDX-License-Identifier: LGPL-2.1-or-later

#include "expression.h"

#include "dealii_message.h"
#include "input_error.h"
#include "number_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

namespace abut::app
{
  namespace
  {
    using Constants = std::map<std::string, double>;

    const Constants::value_type pi = {"pi", 3.14159265358979323846};

    /** deal.II prints the parser's message on std::cerr before it throws;
     * the program wants to print it once, with file and parameter. */
    class SilentErrorStream
    {
    public:
      SilentErrorStream() : saved(std::cerr.rdbuf(sink.rdbuf()))
      {
      }
      ~SilentErrorStream()
      {
        std::cerr.rdbuf(saved);
      }
      SilentErrorStream(const SilentErrorStream &) = delete;
      SilentErrorStream &operator=(const SilentErrorStream &) = delete;

    private:
      std::ostringstream sink;
      std::streambuf *saved;
    };

    /** The parser's own sentence out of deal.II's exception. */
    std::string parser_message(const std::exception &error)
    {
      const std::string text = dealii_message(error);
      const std::string before = "The parser said: ";
      const std::size_t at = text.find(before);
      return at == std::string::npos ? text : text.substr(at + before.size());
    }

    /** Commas separate arguments, unless the parser complains of these. */
    std::string hint(const std::string &text, const std::string &complaint)
    {
      const bool is_of_commas =
          complaint.find("parameters") != std::string::npos
          || complaint.find("arguments") != std::string::npos;
      return is_of_commas || text.find(',') == std::string::npos
                 ? misread_hint(text)
                 : "";
    }

    /** What is wrong with a value beyond largest_value. */
    std::string how_large(const double value)
    {
      return std::isnan(value)      ? "not a number"
             : std::isfinite(value) ? "too large"
             : value > 0            ? "infinite"
                                    : "minus infinity";
    }

    std::string must_be_finite()
    {
      std::ostringstream text;
      text << "; it must be finite, and at most " << largest_value;
      return text.str();
    }

    template <int dim> std::set<std::string> coordinate_names()
    {
      std::set<std::string> names = {"x", "y"};
      if (dim == 3)
        names.insert("z");
      return names;
    }

    /** A formula with rand() has no name of a variable but is no constant. */
    bool is_random(const std::set<std::string> &names)
    {
      return names.count("rand") + names.count("rand_seed") > 0;
    }

    template <int dim>
    std::unique_ptr<dealii::FunctionParser<dim>>
    make_parser(const std::vector<std::string> &formulas,
                const std::string &text, const std::string &parameter,
                Constants constants)
    {
      constants.insert(pi);
      const SilentErrorStream silence;
      auto parser = std::make_unique<dealii::FunctionParser<dim>>(
          static_cast<unsigned int>(formulas.size()));
      try
      {
        parser->initialize(dealii::FunctionParser<dim>::default_variable_names()
                               + ",t",
                           formulas, constants, true);
        for (unsigned int c = 0; c < formulas.size(); ++c)
          parser->value(dealii::Point<dim>(), c);
      }
      catch (const std::exception &error)
      {
        throw InputError(parameter,
                         "the formula '" + text + "' cannot be read: "
                             + parser_message(error) + " Variables are "
                             + (dim == 3 ? "x, y, z, t." : "x, y, t.")
                             + hint(text, parser_message(error)));
      }
      return parser;
    }
  } // namespace

  std::set<std::string> names_in(const std::string &formula)
  {
    const auto letter = [](char c)
    { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    const auto digit = [](char c)
    { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    std::set<std::string> names;
    for (std::size_t i = 0; i < formula.size();)
    {
      std::size_t end = i + 1;
      if (letter(formula[i]))
      {
        while (end < formula.size()
               && (letter(formula[end]) || digit(formula[end])))
          ++end;
        names.insert(formula.substr(i, end - i));
      }
      else if (digit(formula[i]) || formula[i] == '.')
      {
        while (end < formula.size()
               && (digit(formula[end]) || formula[end] == '.'))
          ++end;
        // 2e-3, but not the product-less "2exp(x)", which is an error anyway
        if (end + 1 < formula.size()
            && (formula[end] == 'e' || formula[end] == 'E')
            && (digit(formula[end + 1]) || formula[end + 1] == '-'
                || formula[end + 1] == '+'))
          end += 2;
      }
      i = end;
    }
    return names;
  }

  std::vector<std::string> split_list(const std::string &text,
                                      const char separator)
  {
    std::vector<std::string> parts;
    if (text.find_first_not_of(" \t") == std::string::npos)
      return parts;
    int depth = 0;
    std::string part;
    const auto finish = [&parts, &part]()
    {
      const std::size_t first = part.find_first_not_of(" \t");
      const std::size_t last = part.find_last_not_of(" \t");
      parts.push_back(first == std::string::npos
                          ? std::string()
                          : part.substr(first, last - first + 1));
      part.clear();
    };
    for (const char c : text)
    {
      depth += (c == '(') - (c == ')');
      if (c == separator && depth <= 0)
        finish();
      else
        part += c;
    }
    finish();
    return parts;
  }

  template <int dim>
  Expression<dim>::Expression(const std::string &text,
                              const std::string &parameter,
                              const unsigned int n_components,
                              const std::map<std::string, double> &constants)
      : dealii::Function<dim>(n_components),
        formula(text),
        parameter_name(parameter),
        uses_time(false)
  {
    check_numbers(text, parameter);
    std::vector<std::string> formulas = split_list(text, ';');
    if (n_components > 1 && formulas.size() == 1)
      formulas = split_list(text, ',');
    if (formulas.size() != n_components
        || std::find(formulas.begin(), formulas.end(), "") != formulas.end())
      throw InputError(
          parameter, "'" + text + "' is not "
                         + (n_components == 1
                                ? std::string("a formula.")
                                : std::to_string(n_components)
                                      + " formulas separated by commas or ';'.")
                         + misread_hint(text));
    for (const std::string &formula : formulas)
      check_one_formula(formula, text, parameter);
    auto all = make_parser<dim>(formulas, text, parameter, constants);

    bool any_varies = false;
    const std::set<std::string> coordinates = coordinate_names<dim>();
    for (unsigned int c = 0; c < n_components; ++c)
    {
      const std::set<std::string> names = names_in(formulas[c]);
      const bool in_time = names.count("t") > 0;
      const bool varies =
          in_time || is_random(names)
          || std::any_of(coordinates.begin(), coordinates.end(),
                         [&names](const std::string &coordinate)
                         { return names.count(coordinate) > 0; });
      const double constant = varies ? 0. : all->value(dealii::Point<dim>(), c);
      if (!(std::abs(constant) <= largest_value))
        throw InputError(parameter, "'" + text + "' is " + how_large(constant)
                                        + must_be_finite() + ".");
      components.push_back({!varies, constant});
      uses_time = uses_time || in_time;
      any_varies = any_varies || varies;
    }
    if (any_varies)
      parser = std::move(all);
  }

  template <int dim>
  double Expression<dim>::value(const dealii::Point<dim> &point,
                                const unsigned int component) const
  {
    AssertIndexRange(component, components.size());
    const Component &c = components[component];
    return c.constant ? c.value : parser->value(point, component);
  }

  template <int dim>
  void
  Expression<dim>::value_list(const std::vector<dealii::Point<dim>> &points,
                              std::vector<double> &values,
                              const unsigned int component) const
  {
    AssertDimension(points.size(), values.size());
    const Component &c = components[component];
    if (c.constant)
      std::fill(values.begin(), values.end(), c.value);
    else
      for (std::size_t i = 0; i < points.size(); ++i)
        values[i] = parser->value(points[i], component);
  }

  template <int dim>
  dealii::Tensor<1, dim>
  Expression<dim>::gradient(const dealii::Point<dim> &point,
                            const unsigned int component) const
  {
    dealii::Tensor<1, dim> result;
    if (components[component].constant)
      return result;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double step = 1e-5 * std::max(length, std::abs(point[d]));
      dealii::Point<dim> ahead = point;
      dealii::Point<dim> behind = point;
      ahead[d] += step;
      behind[d] -= step;
      result[d] = (value(ahead, component) - value(behind, component))
                  / (ahead[d] - behind[d]);
    }
    return result;
  }

  template <int dim> void Expression<dim>::set_time(const double time)
  {
    dealii::Function<dim>::set_time(time);
    if (parser)
      parser->set_time(time);
  }

  template <int dim> void Expression<dim>::set_length(const double half_extent)
  {
    length = half_extent;
  }

  template <int dim>
  std::vector<double>
  Expression<dim>::evaluate(const std::vector<dealii::Point<dim>> &points,
                            const unsigned int component) const
  {
    std::vector<double> values(points.size());
    value_list(points, values, component);
    for (std::size_t i = 0; i < points.size(); ++i)
      check_finite(values[i], points[i], parameter_name, formula);
    return values;
  }

  template <int dim>
  bool Expression<dim>::is_constant(const unsigned int component) const
  {
    AssertIndexRange(component, components.size());
    return components[component].constant;
  }

  template <int dim> bool Expression<dim>::is_wholly_constant() const
  {
    return std::all_of(components.begin(), components.end(),
                       [](const Component &c) { return c.constant; });
  }

  template <int dim>
  bool Expression<dim>::is_zero(const unsigned int component) const
  {
    return is_constant(component)
           && this->value(dealii::Point<dim>(), component) == 0.;
  }

  template <int dim> bool Expression<dim>::depends_on_time() const
  {
    return uses_time;
  }

  template <int dim> const std::string &Expression<dim>::text() const
  {
    return formula;
  }

  template <int dim> const std::string &Expression<dim>::parameter() const
  {
    return parameter_name;
  }

  template <int dim>
  void check_finite(const double value, const dealii::Point<dim> &point,
                    const std::string &parameter, const std::string &formula)
  {
    if (std::abs(value) <= largest_value)
      return;
    std::ostringstream text;
    text << "the value ";
    if (!formula.empty())
      text << "of '" << formula << "' ";
    text << "at the point (";
    for (unsigned int d = 0; d < dim; ++d)
      text << (d > 0 ? ", " : "") << point[d];
    text << ") is " << how_large(value) << must_be_finite()
         << " everywhere in the mesh.";
    throw InputError(parameter, text.str());
  }

  template <int dim>
  void checked_values(const dealii::Function<dim> &function,
                      const std::vector<dealii::Point<dim>> &points,
                      const std::string &parameter, std::vector<double> &values)
  {
    values.resize(points.size());
    function.value_list(points, values);
    for (std::size_t i = 0; i < points.size(); ++i)
      check_finite(values[i], points[i], parameter);
  }

  template <int dim>
  CheckedExpression<dim>::CheckedExpression(const Expression<dim> &expression)
      : dealii::Function<dim>(expression.n_components), expression(expression)
  {
  }

  template <int dim>
  double CheckedExpression<dim>::value(const dealii::Point<dim> &point,
                                       const unsigned int component) const
  {
    const double result = expression.value(point, component);
    check_finite(result, point, expression.parameter(), expression.text());
    return result;
  }

  template class CheckedExpression<2>;
  template class CheckedExpression<3>;
  template class Expression<2>;
  template class Expression<3>;
  template void check_finite<2>(double, const dealii::Point<2> &,
                                const std::string &, const std::string &);
  template void check_finite<3>(double, const dealii::Point<3> &,
                                const std::string &, const std::string &);
  template void checked_values<2>(const dealii::Function<2> &,
                                  const std::vector<dealii::Point<2>> &,
                                  const std::string &, std::vector<double> &);
  template void checked_values<3>(const dealii::Function<3> &,
                                  const std::vector<dealii::Point<3>> &,
                                  const std::string &, std::vector<double> &);
} // namespace abut::app
