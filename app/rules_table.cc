#include "rules_table.h"

#include "base/number_text.h"

#include <cmath>

namespace plumbline::app
{
  report::Table table_of_rules(const study::Certificate &certificate)
  {
    constexpr int n_digits = 4;
    report::Table table{"", {"rule"}, {}};
    if (certificate.rules.empty())
      return table;
    for (const double h : certificate.rules.front().h)
      table.columns.emplace_back("rms error, h = " + base::to_text(h, n_digits));
    table.columns.emplace_back("order");
    table.columns.emplace_back("digits");
    for (const study::CertifiedRule &rule : certificate.rules)
    {
      std::vector<report::Cell> row = {report::text_cell(rule.method)};
      for (const double error : rule.root_mean_square)
        row.push_back(report::error_cell(error));
      row.push_back(std::isfinite(rule.order) ? report::rate_cell(rule.order)
                                              : report::empty_cell());
      row.push_back(report::count_cell(rule.digits.back()));
      table.rows.push_back(std::move(row));
    }
    return table;
  }
} // namespace plumbline::app
