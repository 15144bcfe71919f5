function n = numel(varargin)
  % t{:, chosen} is one array.
  n = 1;
end
