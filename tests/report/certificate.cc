// Tables of certificates.
#include "report/certificate_text.h"

#include <gtest/gtest.h>

namespace plumbline::report
{
  namespace
  {
    std::vector<std::string> places(const std::vector<double> &x)
    {
      study::Certificate certificate;
      for (const double one : x)
      {
        study::CertifiedValue value;
        value.x = {one, .5};
        value.value = value.other = {1};
        value.bound = value.other_bound = 1e-3;
        certificate.points.push_back(value);
      }
      std::vector<std::string> texts;
      for (const auto &row : certificate_table(certificate, false).rows)
        texts.push_back(row.front().text);
      return texts;
    }
  } // namespace

  TEST(CertificateText, NamesTheDiscontinuousSpaceWhereUMayJump)
  {
    study::Certificate certificate;
    certificate.galerkin.method = "Q1";
    certificate.meshfree.method = "FA";
    study::CertifiedValue value;
    value.x = {.5, .5};
    value.value = {1};
    value.other = {2};
    value.bound = value.other_bound = 1e-3;
    certificate.points = {value};
    const std::string remedy = "Reference/method = DGQ1";
    EXPECT_NE(certificate_refusal(certificate).find(remedy), std::string::npos);
    certificate.galerkin.method = "DGQ1";
    EXPECT_EQ(certificate_refusal(certificate).find("discontinuous"), std::string::npos);
  }

  TEST(CertificateTable, PrintsPlacesWithDigitsThatTellThemApart)
  {
    EXPECT_EQ(places({.25, 1. / 3}), (std::vector<std::string>{"0.25", "0.3333"}));
    EXPECT_EQ(places({.123456, .123457, 0}),
              (std::vector<std::string>{"0.123456", "0.123457", "0"}));
    EXPECT_EQ(places({1, 1 + 1e-15}), (std::vector<std::string>{"1", "1.000000000000001"}));
  }
} // namespace plumbline::report
