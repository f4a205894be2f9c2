// deal.II's numbers.h includes all of Trilinos' Sacado for the sake of numbers that know their derivatives. No source
// here has any: this file stands before that one, which spares a tenth of the compiler's time.
#pragma once
