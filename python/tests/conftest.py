"""Where the models stand, and nothing drawn on a screen."""

from __future__ import annotations

import os
from pathlib import Path

os.environ.setdefault("MPLBACKEND", "Agg")

CHECKOUT = Path(__file__).parents[2]
MODELS = CHECKOUT / "models"
