"""Writes tiny_network.npz and prints what NumPy makes of it, for authors_network_test.cpp. Needs NumPy.

usage: make_tiny_network.py
"""
import pathlib

import numpy

STATES = [(-25.0, 4.0, 20.0, 9.0), (-50.0, 0.0, 0.0, 0.0), (0.0, -8.0, -40.0, 18.0), (10.0, 1.0, 90.0, 30.0)]
SIZES = [("MLP_0_Dense_0", 4, 5), ("MLP_0_Dense_1", 5, 3), ("OutputVDense", 3, 1)]

arrays = {}
for number, (name, inputs, outputs) in enumerate(SIZES):
    places = numpy.arange(inputs * outputs).reshape(inputs, outputs)
    arrays[name + "_kernel"] = numpy.sin(1.0 + number + 2.0 * places).astype(numpy.float32)
    arrays[name + "_bias"] = numpy.cos(number + numpy.arange(outputs)).astype(numpy.float32)
arrays["MLP_0_Dense_1_kernel"] = numpy.asfortranarray(arrays["MLP_0_Dense_1_kernel"])
numpy.savez(pathlib.Path(__file__).with_name("tiny_network.npz"), **arrays)

for x, y, yaw, speed in STATES:
    numbers = numpy.array([(x + 50) / 50, abs(y) / 8, abs(yaw) / 40, speed / 18])
    for name, _, _ in SIZES:
        numbers = numbers @ arrays[name + "_kernel"].astype(float) + arrays[name + "_bias"].astype(float)
        if name != SIZES[-1][0]:
            numbers = numpy.maximum(numbers, 0)
    print((x, y, yaw, speed), "%.9f" % numbers[0])
