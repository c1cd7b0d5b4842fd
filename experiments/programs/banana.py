# A density in Python, for `parvi sample --target program --dim 2 --program "python3 experiments/programs/banana.py"`.
# Every line of the input is a question, `density x1 x2` or `score x1 x2`; every question is answered with a line of numbers.
import sys


def log_density(x):
    return -0.5 * x[0] ** 2 - 2.0 * (x[1] - x[0] ** 2) ** 2


def score(x):
    residual = x[1] - x[0] ** 2
    return [-x[0] + 8.0 * x[0] * residual, -4.0 * residual]


for line in sys.stdin:
    question, *numbers = line.split()
    x = [float(number) for number in numbers]
    # Without a gradient: an empty line in the place of the score.
    print(log_density(x) if question == "density" else " ".join(map(str, score(x))), flush=True)
