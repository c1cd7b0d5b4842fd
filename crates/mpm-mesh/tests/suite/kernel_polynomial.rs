//! Polynomials with fractions as coefficients.

/// A fraction in lowest terms with a positive denominator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fraction {
    numerator: i128,
    denominator: i128,
}

fn greatest_common_divisor(a: i128, b: i128) -> i128 {
    if b == 0 {
        a.abs()
    } else {
        greatest_common_divisor(b, a % b)
    }
}

/// a b, which has to fit.
fn product(a: i128, b: i128) -> i128 {
    a.checked_mul(b).expect("within 127 bits")
}

impl Fraction {
    pub fn new(numerator: i128, denominator: i128) -> Self {
        let divisor = greatest_common_divisor(numerator, denominator) * denominator.signum();
        Self {
            numerator: numerator / divisor,
            denominator: denominator / divisor,
        }
    }

    pub fn plus(self, other: Self) -> Self {
        let left = product(self.numerator, other.denominator);
        let right = product(other.numerator, self.denominator);
        Self::new(left + right, product(self.denominator, other.denominator))
    }

    pub fn minus(self, other: Self) -> Self {
        self.plus(Self::new(-other.numerator, other.denominator))
    }

    pub fn times(self, other: Self) -> Self {
        let numerator = product(self.numerator, other.numerator);
        Self::new(numerator, product(self.denominator, other.denominator))
    }

    pub fn is_negative(self) -> bool {
        self.numerator < 0
    }

    pub fn size_is_below(self, limit: Self) -> bool {
        let size = Self::new(self.numerator.abs(), self.denominator);
        size.minus(limit).is_negative()
    }

    pub fn to_f64(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }
}

/// Coefficients of 1, x, x², …, the last of them not zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polynomial(Vec<Fraction>);

impl Polynomial {
    pub fn new(mut coefficients: Vec<Fraction>) -> Self {
        while coefficients.last() == Some(&Fraction::new(0, 1)) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    pub fn constant(value: Fraction) -> Self {
        Self::new(vec![value])
    }

    pub fn x() -> Self {
        Self::new(vec![Fraction::new(0, 1), Fraction::new(1, 1)])
    }

    fn coefficient(&self, power: usize) -> Fraction {
        self.0.get(power).copied().unwrap_or(Fraction::new(0, 1))
    }

    pub fn plus(&self, other: &Self) -> Self {
        let count = self.0.len().max(other.0.len());
        Self::new(
            (0..count)
                .map(|k| self.coefficient(k).plus(other.coefficient(k)))
                .collect(),
        )
    }

    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.times(&Self::constant(Fraction::new(-1, 1))))
    }

    pub fn times(&self, other: &Self) -> Self {
        let mut product = vec![Fraction::new(0, 1); self.0.len() + other.0.len()];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] = product[i + j].plus(a.times(*b));
            }
        }
        Self::new(product)
    }

    pub fn at(&self, x: Fraction) -> Fraction {
        let horner = |sum: Fraction, c: &Fraction| sum.times(x).plus(*c);
        self.0.iter().rev().fold(Fraction::new(0, 1), horner)
    }
}
