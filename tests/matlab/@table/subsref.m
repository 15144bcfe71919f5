function value = subsref(t, s)
  % t.Properties.VariableNames, t.name and t{:, chosen}, as MATLAB gives them.
  names = fieldnames(t.columns)';
  if strcmp(s(1).type, '{}')
    value = cellfun(@(name) double(t.columns.(name)), names(s(1).subs{2}), 'UniformOutput', false);
    value = [value{:}];
  elseif strcmp(s(1).subs, 'Properties')
    value = struct('VariableNames', {names});
  else
    value = t.columns.(s(1).subs);
  end
  if numel(s) > 1
    value = subsref(value, s(2:end));
  end
end
