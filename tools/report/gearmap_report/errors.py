# SPDX-License-Identifier: BSD-2-Clause
"""What a person can put right: one sentence."""


class ReportError(Exception):
    pass
