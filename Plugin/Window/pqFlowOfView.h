// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqView;

/// Selects the flow that a view draws as Schlieren when the user clicks into it, so that the panel has its settings;
/// unless the view shows what is selected.
class pqFlowOfView : public QObject
{
  Q_OBJECT

public:
  explicit pqFlowOfView(QObject* parent);
  ~pqFlowOfView() override;

private:
  void onViewChanged(pqView* view);
};
