"""Fixtures of what every renderer is held to."""

import pytest

from rtb_addon.renderers import find
from rtb_addon.renderers.tracer import together


@pytest.fixture(params=["mitsuba", "tracer"])
def renderer(request):
    return find(request.param)


@pytest.fixture(scope="module", autouse=True)
def no_process_stays():
    yield
    together.stop_processes()
